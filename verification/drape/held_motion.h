// SPDX-License-Identifier: MIT
// Where the held places of a scene are at a time: the same rule for the vertices of a coarse or
// fine cloth and for the nodes of a finite-element reference.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "verification/drape/scene/scene.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A sheet as a scene places it: 0 to 1 from edge to edge, and where a point begins.
struct SheetPlacement
{
  std::function<Eigen::RowVector2d(const Eigen::RowVector2d &rest_point)> fraction; ///< [-]
  std::function<Eigen::RowVector3d(const Eigen::RowVector2d &rest_point)> start;    ///< [m]
};

/// @param origin lower-left corner of the sheet at rest [m]
/// @param sides rows: its sides at rest [m]
SheetPlacement placement_of(const Scene &scene, const Eigen::RowVector2d &origin,
                            const Eigen::Matrix2d &sides);

/// The held places of a scene on one cloth. Coarse and fine cloth hold the same places and turn
/// them about the same centres: `vertices ...` are vertices of the coarse cloth, and of the fine
/// one those at the same points.
class HeldMotion
{
public:
  /// Of a sheet, coarse or fine. Vertices are numbered as in meshes::coarse_sheet().
  HeldMotion(const Scene &scene, const SheetPlacement &placement, const Eigen::RowVector2d &origin,
             const Eigen::Matrix2d &sides);

  /// Of a garment, by its vertices in space.
  /// @param fine_of_coarse fine vertex at each coarse one, −1 where there is none; empty: of the
  ///   coarse cloth
  /// @throws BadInput where a held vertex is no vertex of the fine cloth
  HeldMotion(const Scene &scene, const meshes::ClothMesh &coarse,
             const std::vector<int> &fine_of_coarse = {});

  /// Position of a held point of a sheet at a time, nothing where it is free.
  std::optional<Eigen::RowVector3d> at(const Eigen::RowVector2d &rest_point, double time) const;

  /// Held vertices of a cloth.
  std::vector<int> vertices(const meshes::ClothMesh &cloth) const;

  /// Positions of these vertices at a time.
  Eigen::RowVector3d position(int vertex, const meshes::ClothMesh &cloth, double time) const;

  /// The place that holds a vertex, −1 where none does; later places win.
  int place_of_vertex(int vertex, const meshes::ClothMesh &cloth) const;

  /// The places as the scene calls them, such as `top left` or `vertices 0 20`.
  std::vector<std::string> names() const;

  /// Whether anything moves at or after a time.
  bool moves_after(double time) const;

  /// Places that hold no vertex of a cloth, as the scene calls them: later places win.
  std::vector<std::string> idle_places(const meshes::ClothMesh &cloth) const;

private:
  struct HeldPart
  {
    HeldPlace held;
    Eigen::RowVector3d centre;                 ///< about which it rotates [m]
    std::vector<int> vertices;                 ///< of `vertices ...` on this garment
    std::vector<Eigen::RowVector2d> fractions; ///< of `vertices ...` on a sheet
  };
  bool holds(const HeldPart &place, const Eigen::RowVector2d &fraction) const;
  bool holds(const HeldPart &place, int vertex, const meshes::ClothMesh &garment) const;

  std::optional<SheetPlacement> placement;
  /// By how much a fraction may miss an edge or a vertex and be on it, as cells may whose
  /// coordinates are rounded.
  Eigen::Array<double, 1, 2> on_edge = Eigen::Array<double, 1, 2>::Zero();
  std::vector<HeldPart> places;
  double waist = 0.; ///< height above which a vertex belongs to the waist [m]
};
} // namespace homespun::verification
