// SPDX-License-Identifier: MIT
// Unit cells made in code, and what theory says of them.
#pragma once

#include "homogenization/homogenize.h"
#include "tests/meshes/shapes.h"

#include <Eigen/LU>

#include <functional>

namespace homespun::tests
{
/// A cell of n1 x n2 x 2 triangles; the phase is chosen by the fractional coordinates of a square.
inline homogenization::UnitCell cell_of(const meshes::Lattice &lattice, const int n1, const int n2,
                                        const std::vector<homogenization::Phase> &phases,
                                        const std::function<int(double f1, double f2)> &phase_at)
{
  homogenization::UnitCell cell;
  cell.name    = "test";
  cell.lattice = lattice;
  cell.mesh    = parallelogram(lattice, n1, n2);
  cell.phases  = phases;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    cell.mesh.material(t) =
      phase_at((t / 2 % n1 + 0.5) / n1, (static_cast<double>(t / 2 / n1) + 0.5) / n2);
  return cell;
}

/// Soft and hard halves, stacked along axis 2.
inline int halves(double, const double f2)
{
  return f2 < 0.5 ? 0 : 1;
}

/// An inclusion of a quarter of the area.
inline int square_inclusion(const double f1, const double f2)
{
  return std::abs(f1 - 0.5) < 0.25 && std::abs(f2 - 0.5) < 0.25 ? 1 : 0;
}

inline std::vector<homogenization::Phase> soft_and_hard()
{
  return {homogenization::isotropic("soft", 1., 0.3, 1., 1.),
          homogenization::isotropic("hard", 10., 0.3, 1., 1.)};
}

/// The stiffness of a laminate of any anisotropic layers stacked along axis 2. Across the layers the
/// strain 11 and the stresses 22, 12 are continuous; with a = (22, 12) and b = 11,
///   C_aa = <c_aa^-1>^-1,  C_ba = <c_ba c_aa^-1> C_aa,
///   C_bb = <c_bb − c_ba c_aa^-1 c_ab> + C_ba C_aa^-1 C_ab.
inline Eigen::Matrix3d laminate(const std::vector<Eigen::Matrix3d> &layers,
                                const std::vector<double> &fractions)
{
  Eigen::Matrix2d mean_inverse  = Eigen::Matrix2d::Zero();
  Eigen::RowVector2d mean_ratio = Eigen::RowVector2d::Zero();
  double mean_rest              = 0.;
  for (std::size_t k = 0; k < layers.size(); ++k)
  {
    const Eigen::Matrix2d inverse = layers[k].bottomRightCorner<2, 2>().inverse();
    const Eigen::RowVector2d c_ba = layers[k].block<1, 2>(0, 1);
    mean_inverse += fractions[k] * inverse;
    mean_ratio += fractions[k] * c_ba * inverse;
    mean_rest += fractions[k] * (layers[k](0, 0) - c_ba * inverse * c_ba.transpose());
  }
  Eigen::Matrix3d C;
  const Eigen::Matrix2d C_aa    = mean_inverse.inverse();
  const Eigen::RowVector2d C_ba = mean_ratio * C_aa;
  C.bottomRightCorner<2, 2>()   = C_aa;
  C.block<1, 2>(0, 1)           = C_ba;
  C.block<2, 1>(1, 0)           = C_ba.transpose();
  C(0, 0)                       = mean_rest + C_ba * mean_ratio.transpose();
  return C;
}

inline homogenization::Homogenization solved(const homogenization::UnitCell &cell,
                                             const unsigned int order = 1)
{
  homogenization::HomogenizationOptions options;
  options.order     = order;
  options.tolerance = 1e-12;
  return homogenization::homogenize(cell, options, MPI_COMM_SELF);
}

/// Largest difference of entries, relative to the largest entry.
inline double relative_difference(const Eigen::Matrix3d &a, const Eigen::Matrix3d &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}
} // namespace homespun::tests
