// SPDX-License-Identifier: MIT
// The loads of a strain study: what is held and how far it is moved. Said once, for the coarse
// cloth and for the fine references alike.
#pragma once

#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
enum class LoadKind
{
  periodic,   ///< infinite cloth under a given deformation gradient
  free_sides, ///< infinite cloth pulled along an axis that keeps its direction, its sides free
  sheet       ///< the two edges normal to an axis clamped, the far one moved, the others free
};

/// What the program has to know of a load.
struct LoadProperties
{
  const char *name;
  const char *label; ///< as a picture in words
  LoadKind kind;
  bool is_in_default_study;
  /// Of periodic loads G11, G12, G21, G22 of F = I + strain G.
  std::array<double, 4> gradient;
  int axis = 0; ///< 0 or 1: that is pulled, or along which the clamps are apart
  /// Of sheets, the axis along which the far edge moves, by strain times its distance.
  int moved_axis = 0;
};

/// The one list, from which messages, defaults and schema.json are made. `periodic-all`: what is of
/// second order in strain mixes its three strains, and no two are equal.
inline constexpr std::array<LoadProperties, 9> load_table = {{
  {"periodic-11", "Endless cloth, stretched along axis 1", LoadKind::periodic, true, {1, 0, 0, 0}},
  {"periodic-22", "Endless cloth, stretched along axis 2", LoadKind::periodic, true, {0, 0, 0, 1}},
  {"periodic-12", "Endless cloth, sheared", LoadKind::periodic, true, {0, 1, 0, 0}},
  {"periodic-all", "Endless cloth, all strains", LoadKind::periodic, false, {1, 1, 0, 0.5}},
  {"uniaxial-1",
   "Endless cloth, pulled along axis 1 with free sides",
   LoadKind::free_sides,
   false,
   {},
   0},
  {"uniaxial-2",
   "Endless cloth, pulled along axis 2 with free sides",
   LoadKind::free_sides,
   false,
   {},
   1},
  {"strip-1", "Sheet pulled along axis 1", LoadKind::sheet, true, {}, 0, 0},
  {"strip-2", "Sheet pulled along axis 2", LoadKind::sheet, true, {}, 1, 1},
  {"shear-frame", "Sheet sheared in a frame", LoadKind::sheet, true, {}, 1, 0},
}};

/// A load by its name. With free sides F = (1 + strain, g; 0, 1 + e) or (1 + e, 0; g, 1 + strain)
/// with the free strains e and g that each cloth finds for itself.
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

  /// All of one kind.
  static std::vector<std::string> names_of(LoadKind kind);

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

  /// 0 or 1: the axis that is pulled where sides are free; of a sheet that of its fractions along
  /// which the clamps are apart: the one at 0 stays, the one at 1 moves.
  int axis() const;

  const std::string name;

private:
  const LoadProperties *properties;
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
