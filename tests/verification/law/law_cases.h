// SPDX-License-Identifier: MIT
// What the tests of laws in the plane and in space share.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>

namespace homespun::tests
{
/// Without a symmetry (3,3) [N/m].
inline Eigen::Matrix3d some_stiffness()
{
  Eigen::Matrix3d C;
  C << 5., 1.1, 0.4, 1.1, 2., -0.3, 0.4, -0.3, 0.9;
  return C;
}

/// @param E1,E2,G12 [N/m]
/// @param nu12 contraction across over stretch along, of a pull along axis 1
inline Eigen::Matrix3d orthotropic(const double E1, const double E2, const double nu12,
                                   const double G12)
{
  Eigen::Matrix3d compliance;
  compliance << 1. / E1, -nu12 / E1, 0., -nu12 / E1, 1. / E2, 0., 0., 0., 1. / G12;
  return compliance.inverse();
}

inline Eigen::Matrix2d rotation(const double angle)
{
  Eigen::Matrix2d R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R;
}

/// A deformation with a turn and a shear (2,2).
inline Eigen::Matrix2d some_gradient()
{
  Eigen::Matrix2d F;
  F << 1.12, 0.31, -0.18, 0.93;
  return F;
}

/// The order at which a remainder falls over six halvings of a step.
template <typename Remainder>
double order_over_six_halvings(const double step, Remainder &&remainder)
{
  return std::log2(remainder(step) / remainder(step / 64.)) / 6.;
}
} // namespace homespun::tests
