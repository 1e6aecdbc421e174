// SPDX-License-Identifier: MIT
// The triangles of a periodic cloth in parts of its lattice vectors: a cell with its opposite sides
// glued, whose outline may cut holes. It can be cut open again elsewhere, along two straight lines,
// one along each lattice vector.
//
// Whatever the lines cross is split once, on the glued mesh. Both sides of the new cell get their
// vertices from that one split, so that they match by construction.
#pragma once

#include "homogenization/cell/curved_sides.h"
#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace homespun::homogenization
{
/// A vertex of the glued mesh, and by how many lattice vectors it is moved.
struct LatticeCorner
{
  int vertex;
  Eigen::RowVector2i offset;
};

/// An edge of the glued mesh, the same from either end and in every cell: both vertices, the lower
/// one first, and the offset of the second one relative to the first.
using LatticeEdge = std::array<int, 4>;

/// The edge between two corners.
LatticeEdge edge_between(const LatticeCorner &from, const LatticeCorner &to);

struct LatticeTriangle
{
  std::array<LatticeCorner, 3> corners; ///< counter-clockwise
  int material;                         ///< as in the mesh that was glued
  int group; ///< within a group vertices may move: it is of one material, or of one turned
};

/// Plain data, made and changed by the functions below.
struct LatticeTriangles
{
  meshes::Lattice lattice;
  std::vector<Eigen::RowVector2d> places; ///< of the vertices, in parts of the lattice vectors
  std::vector<LatticeTriangle> triangles;
  std::map<LatticeEdge, Eigen::RowVector2d> bulges; ///< sagittas of curved edges between groups and
                                                    ///< on rims, in parts of the lattice vectors

  /// Where a corner lies, in parts of the lattice vectors.
  Eigen::RowVector2d at(const LatticeCorner &corner) const
  {
    return places[static_cast<std::size_t>(corner.vertex)] + corner.offset.cast<double>();
  }
};

/// A closed rim of the glued mesh, the mesh on its left: clockwise around a hole.
struct Rim
{
  std::vector<Eigen::RowVector2d> points; ///< of its vertices, one after the other without a jump
  std::vector<Eigen::RowVector2d> reach;  ///< beside them what a curved edge stays within
  Eigen::RowVector2i period = {0, 0};     ///< not zero where it ends at an image of its beginning
  double area               = 0.;         ///< enclosed, in parts of the cell, negative of a hole
  /// The triangle, and which of its sides, that is the edge from each point on.
  std::vector<std::array<int, 2>> sides;
  /// At each point the angle of the void, from the edge that ends there to the one that begins
  /// [rad]; zero where the two lie on each other, negative where triangles overlap.
  std::vector<double> void_angles;

  /// Where the edge that begins at a point ends.
  Eigen::RowVector2d end_of(const std::size_t k) const
  {
    return k + 1 < points.size() ? points[k + 1] : points[0] + period.cast<double>();
  }
};

/// Glues a mesh whose outline may cut holes: boundary vertices that are lattice images are one.
/// @param group (n_triangles)
/// @return nothing where the triangles do not then lie side by side: vertices that coincide without
///   being one, edges with more than two triangles
std::optional<LatticeTriangles>
glued_with_rims(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                const Eigen::VectorXi &group, const std::vector<CurvedSide> &curved_sides,
                double relative_tolerance = meshes::image_tolerance);

/// The rims that are left when images are glued.
std::vector<Rim> rims_of(const LatticeTriangles &mesh);

/// A mesh that has been cut, where, and how good the triangles are that the cut changed.
struct LineCut
{
  LatticeTriangles mesh;
  double level          = 0.;
  double smallest_angle = 180.; ///< of the triangles that changed [degrees]
};

/// Makes the line on which coordinate `axis` has one of the levels, and all its images, a line of
/// edges: at the level that leaves the best triangles, the first of equals.
///
/// Vertices on the line are used. Those near to it that lie inside of a group are moved onto it,
/// along lattice vector `axis`; all other edges that cross it are split, curved ones where the
/// curve does. Areas of groups stay the same where edges are straight.
/// @return nothing where at each level a curve crosses the line but not its chord, or a triangle
///   crosses two images of the line
std::optional<LineCut> cut_along(const LatticeTriangles &mesh, int axis,
                                 const std::vector<double> &levels);

/// The cell from `corner` on, cut along both lines, as a mesh in the plane.
/// @param corner in parts of the lattice vectors; the mesh has been cut along both lines there
/// @param curved_sides is given those of the new cell
meshes::TriangleMesh unfolded_at(const LatticeTriangles &mesh, const Eigen::RowVector2d &corner,
                                 std::vector<CurvedSide> &curved_sides);
} // namespace homespun::homogenization
