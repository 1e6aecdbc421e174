// SPDX-License-Identifier: MIT
// What a cloth sets against being bent: the stiffness of an orthotropic plate, in its two
// directions and in the twist.
#pragma once

#include <Eigen/Core>

namespace homespun::shell
{
/// Bending stiffness of an orthotropic plate: moments (M11, M22, M12) = D (κ11, κ22, 2 κ12).
struct PlateStiffness
{
  double D11 = 0.; ///< about direction 2, bending along 1 [N m]
  double D22 = 0.; ///< [N m]
  double D12 = 0.; ///< what bending along 1 asks of moments along 2 [N m]
  double D66 = 0.; ///< twist: M12 = D66 2 κ12 [N m]

  /// D in both directions, D12 = nu D, D66 = D (1 − nu)/2; D = E t³/(12 (1 − nu²)) of a thick
  /// sheet.
  static PlateStiffness isotropic(double D, double nu);

  /// (3,3), Voigt order 11, 22, 12 [N m]
  Eigen::Matrix3d matrix() const;

  /// Whether every bent shape costs energy: all finite, D11, D22, D66 > 0, D12² < D11 D22.
  bool is_positive_definite() const;
};
} // namespace homespun::shell
