// SPDX-License-Identifier: MIT
#include "homogenization/cell/quadratic_strain.h"

#include "meshes/plain/yarn_axes.h"

#include <Eigen/LU>

#include <algorithm>
#include <stdexcept>

namespace homespun::homogenization
{
namespace
{
/// The symmetric form of the product of two linear ones.
Eigen::Matrix4d product(const GradientEntries &first, const GradientEntries &second)
{
  return 0.5 * (first * second.transpose() + second * first.transpose());
}

/// q of the strain e in the axes of yarns, as the strain turns^-1 e in those of the cell.
QuadraticStrain of_yarns(const meshes::YarnAxes &yarns)
{
  const auto entry = [&](const int i, const int j) // a_i.H a_j
  {
    const Eigen::Vector2d a = yarns.axes.col(i), b = yarns.axes.col(j);
    return GradientEntries(a(0) * b(0), a(0) * b(1), a(1) * b(0), a(1) * b(1));
  };
  const GradientEntries H11 = entry(0, 0), H12 = entry(0, 1), H21 = entry(1, 0), H22 = entry(1, 1);
  const QuadraticStrain in_axes = {0.5 * product(H21, H21), 0.5 * product(H12, H12),
                                   -(product(H11, H21) + product(H22, H12))};
  const Eigen::Matrix3d back    = yarns.turns.inverse();
  QuadraticStrain q;
  for (std::size_t k = 0; k < q.size(); ++k)
    q[k] = back(static_cast<Eigen::Index>(k), 0) * in_axes[0] +
           back(static_cast<Eigen::Index>(k), 1) * in_axes[1] +
           back(static_cast<Eigen::Index>(k), 2) * in_axes[2];
  return q;
}
} // namespace

std::vector<Law> laws_of_second_order(const std::vector<Phase> &phases)
{
  const bool have_axes = std::any_of(
    phases.begin(), phases.end(),
    [](const Phase &phase) { return meshes::yarn_axes(plane_stress_stiffness(phase)).are_there; });
  std::vector<Law> laws;
  for (const Law law : meshes::all_laws())
    if (const meshes::LawProperties &of = meshes::properties_of(law);
        of.has_second_order && (have_axes || !of.has_yarns))
      laws.push_back(law);
  return laws;
}

namespace
{
QuadraticStrain of_biot()
{
  const GradientEntries H11 = GradientEntries::Unit(0), H12 = GradientEntries::Unit(1),
                        H21 = GradientEntries::Unit(2), H22 = GradientEntries::Unit(3);
  const GradientEntries shear = H12 + H21, turn = 0.5 * (H21 - H12);
  return {0.5 * (product(shear, turn) + product(turn, turn)),
          0.5 * (product(turn, turn) - product(shear, turn)), product(H22 - H11, turn)};
}

QuadraticStrain of_green()
{
  const GradientEntries H11 = GradientEntries::Unit(0), H12 = GradientEntries::Unit(1),
                        H21 = GradientEntries::Unit(2), H22 = GradientEntries::Unit(3);
  return {0.5 * (product(H11, H11) + product(H21, H21)),
          0.5 * (product(H12, H12) + product(H22, H22)), product(H11, H12) + product(H21, H22)};
}
} // namespace

QuadraticStrain quadratic_strain(const Law law, const Phase &phase)
{
  switch (law)
  {
  case Law::linear:
    break;
  case Law::biot:
    return of_biot();
  case Law::green:
    return of_green();
  case Law::yarn:
    const meshes::YarnAxes yarns = meshes::yarn_axes(plane_stress_stiffness(phase));
    return yarns.are_there ? of_yarns(yarns) : of_biot();
  }
  throw std::logic_error("the law " + meshes::name_of(law) + " has no second order");
}

Eigen::Matrix<double, 3, 4> linear_strain()
{
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << 1., 0., 0., 0., 0., 0., 0., 1., 0., 1., 1., 0.;
  return matrix;
}

GradientEntries second_order_stress(const Eigen::Matrix3d &c, const QuadraticStrain &q,
                                    const GradientEntries &F, const GradientEntries &G)
{
  const Eigen::Matrix<double, 3, 4> stress = c * linear_strain();
  const Eigen::Vector3d of_F = stress * F, of_G = stress * G;
  GradientEntries sum = GradientEntries::Zero();
  for (Eigen::Index k = 0; k < 3; ++k)
  {
    const Eigen::Matrix4d &Q = q[static_cast<std::size_t>(k)];
    sum += stress.row(k).transpose() * F.dot(Q * G) + of_F(k) * (Q * G) + of_G(k) * (Q * F);
  }
  return 2. * sum;
}
} // namespace homespun::homogenization
