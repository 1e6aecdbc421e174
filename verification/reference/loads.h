// SPDX-License-Identifier: MIT
// The loads of a strain study: what is held and how far it is moved. Said once, for the coarse
// cloth and for the fine references alike.
#pragma once

#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A load by its name:
/// - periodic-11, periodic-22: infinite cloth under F = I + strain along axis 1 or 2
/// - periodic-12: infinite cloth under simple shear, F = (1, strain; 0, 1)
/// - periodic-all: the three at once, F = (1 + strain, strain; 0, 1 + strain/2): what is of second
///   order in strain mixes them, and no two are equal
/// - uniaxial-1, uniaxial-2: infinite cloth pulled along axis 1 or 2, which keeps its direction,
///   its sides free of stress: F = (1 + strain, g; 0, 1 + e) or (1 + e, 0; g, 1 + strain) with the
///   free strains e and g that each cloth finds for itself
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

  /// Those of a study that is not told otherwise: the periodic ones and those of sheets.
  static const std::vector<std::string> &names();

  /// Whether it is one of an infinite cloth.
  bool is_periodic() const;

  /// Whether it is uniaxial.
  bool has_free_sides() const;

  /// e and g of a cloth at a strain.
  using FreeStrains = std::function<Eigen::Vector2d(double strain)>;

  /// The load with the free strains that a cloth has found.
  Load with_free_strains(FreeStrains strains) const;

  /// The macroscopic deformation gradient of an infinite cloth; with free sides only where the free
  /// strains are known.
  Eigen::Matrix2d gradient(double strain) const;

  /// That of free sides, at any e and g.
  Eigen::Matrix2d gradient(double strain, const Eigen::Vector2d &free_strains) const;

  /// The nominal stresses that work on e and g: P22 and P12, or P11 and P21. Both are zero where
  /// the sides are free.
  Eigen::Vector2d stress_of_sides(const Eigen::Matrix2d &P) const;

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

private:
  FreeStrains free_strains;
};

/// The vertices of a mesh of a sheet that a load holds; of an infinite cloth none.
/// @param rest (n,2) of the resolved mesh or of a coarse one [m]
std::vector<int> held_vertices(const Load &load, const meshes::Sheet &sheet,
                               const meshes::Points &rest);

/// The affine motion that agrees with what is prescribed, of any points of a sheet; of an infinite
/// cloth that of its deformation gradient.
/// @param rest (n,2) [m]
/// @return (n,2) [m]
meshes::Points moved_affinely(const Load &load, const meshes::Sheet &sheet,
                              const meshes::Points &rest, double strain);
} // namespace homespun::verification
