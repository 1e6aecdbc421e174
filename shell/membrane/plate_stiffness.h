// SPDX-License-Identifier: MIT
// What a cloth sets against being bent: the stiffness of a plate, in its two directions, in the
// twist, and what couples them.
#pragma once

#include <Eigen/Core>

namespace homespun::shell
{
/// Bending stiffness of a plate, orthotropic along its directions where D16 = D26 = 0: moments
/// (M11, M22, M12) = D (κ11, κ22, 2 κ12).
struct PlateStiffness
{
  double D11 = 0.; ///< about direction 2, bending along 1 [N m]
  double D22 = 0.; ///< [N m]
  double D12 = 0.; ///< what bending along 1 asks of moments along 2 [N m]
  double D66 = 0.; ///< twist: M12 = D66 2 κ12 [N m]
  double D16 = 0.; ///< what bending along 1 asks of the twist [N m]
  double D26 = 0.; ///< what bending along 2 asks of the twist [N m]

  /// D in both directions, D12 = nu D, D66 = D (1 − nu)/2; D = E t³/(12 (1 − nu²)) of a thick
  /// sheet.
  static PlateStiffness isotropic(double D, double nu);

  /// @param D symmetric (3,3), Voigt order 11, 22, 12 [N m]
  static PlateStiffness from(const Eigen::Matrix3d &D);

  /// (3,3), Voigt order 11, 22, 12 [N m]
  Eigen::Matrix3d matrix() const;

  /// Whether every bent shape costs energy: all finite, and matrix() positive definite.
  bool is_positive_definite() const;
};
} // namespace homespun::shell
