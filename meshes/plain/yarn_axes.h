// SPDX-License-Identifier: MIT
// The axes of a membrane stiffness along its yarns: what the law `yarn` is written in, for the
// coarse cloth and for the references alike.
#pragma once

#include <Eigen/Core>

namespace homespun::meshes
{
/// The axes of a stiffness, and what it is in them.
struct YarnAxes
{
  bool are_there        = false;                       ///< false: it is alike in all directions
  Eigen::Matrix2d axes  = Eigen::Matrix2d::Identity(); ///< columns a1, a2
  Eigen::Matrix3d C     = Eigen::Matrix3d::Zero();     ///< in these axes [N/m]
  Eigen::Matrix3d turns = Eigen::Matrix3d::Identity(); ///< strains (11, 22, 2 x 12) into them
};

/// a1 is the direction of the largest Young's modulus, 1/E = S11 of the compliance turned there,
/// the one nearest to the x axis where several are alike. Of an orthotropic stiffness it is an axis
/// of it if E/G along the axis exceeds 2 (1 + nu). Where 1/E varies by less than a millionth there
/// are none.
/// @param C (3,3) [N/m], positive definite, Voigt 11, 22, 12 with engineering shear
YarnAxes yarn_axes(const Eigen::Matrix3d &C);
} // namespace homespun::meshes
