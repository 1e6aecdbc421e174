// SPDX-License-Identifier: MIT
// The loads of a strain study: what is held and how far it is moved. Said once, for the coarse
// cloth and for the fine references alike.
#pragma once

#include "meshes/plain/lattice.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
/// A load by its name:
/// - periodic-11, periodic-22: infinite cloth under F = I + strain along axis 1 or 2
/// - periodic-12: infinite cloth under simple shear, F = (1, strain; 0, 1)
/// - strip-1, strip-2: the two edges normal to axis 1 or 2 clamped, the far one moved outwards
///   along that axis by strain times length, the other two edges free
/// - shear-frame: the two edges normal to axis 2 clamped, the upper moved along axis 1 by strain
///   times length, sides free
/// The axes of periodic loads are x and y. Those of sheets are the sides of the sheet: on a lattice
/// that is not rectangular the clamped edges are those that a2 (strip-1) or a1 joins, and move
/// along a1 or a2.
class Load
{
public:
  /// @throws BadInput listing the names, where it is none of them
  explicit Load(const std::string &name);

  static const std::vector<std::string> &names();

  bool is_periodic() const;

  /// The macroscopic deformation gradient of a periodic load.
  Eigen::Matrix2d gradient(double strain) const;

  /// Whether a sheet is held at a point.
  /// @param fraction the point's coordinates on the sheet, 0 to 1 from edge to edge
  bool holds(const Eigen::RowVector2d &fraction) const;

  /// The affine displacement of a sheet that agrees with what is prescribed where it is held [m].
  /// @param sides rows: the sides of the sheet [m]
  Eigen::RowVector2d displacement(const Eigen::RowVector2d &fraction, const Eigen::Matrix2d &sides,
                                  double strain) const;

  /// Of a sheet, the axis of its fractions along which the clamps are apart: the one at 0 stays,
  /// the one at 1 moves.
  int clamped_axis() const;

  const std::string name;
};
} // namespace homespun::verification
