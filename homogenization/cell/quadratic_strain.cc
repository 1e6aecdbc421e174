// SPDX-License-Identifier: MIT
#include "homogenization/cell/quadratic_strain.h"

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

QuadraticStrain quadratic_strain(const Law law)
{
  switch (law)
  {
  case Law::linear:
  case Law::yarn:
    break;
  case Law::biot:
    return of_biot();
  case Law::green:
    return of_green();
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
