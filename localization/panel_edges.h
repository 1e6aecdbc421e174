// SPDX-License-Identifier: MIT
// A panel as boundary layers (edge_modes.h) see it: which of its edges lie on lattice lines of its
// cells, and where its fine vertices are. A sheet of whole cells is a panel with four such edges.
// Coordinates are in cells along the lattice vectors.
#pragma once

#include "meshes/plain/cell_edges.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::localization
{
/// An edge on a lattice line that is not sewn.
struct PanelEdge
{
  int side;                      ///< as in meshes::CellEdges: on which side of its line cloth lies
  int line;                      ///< its coordinate of the axis of that side
  std::array<double, 2> ends;    ///< of the other coordinate, the smaller one first
  std::array<bool, 2> is_corner; ///< ends at a convex corner with another such edge, as on a sheet

  int axis() const
  {
    return meshes::axis_of_side(side);
  }

  /// How far a point is from the line, positive where the cloth lies.
  double depth(const Eigen::RowVector2d &point) const
  {
    return meshes::is_far_side(side) ? line - point(axis()) : point(axis()) - line;
  }

  /// The same of a cell, 0 next to the line.
  int depth_of_cell(const int cell) const
  {
    return meshes::is_far_side(side) ? line - 1 - cell : cell - line;
  }
};

struct Panel
{
  Eigen::RowVector2d zero;      ///< a lattice point, in the frame of the cells [m]
  Eigen::RowVector2d low, high; ///< of the outline
  std::vector<PanelEdge> edges; ///< by sides
  std::vector<std::array<Eigen::RowVector2d, 2>> outline; ///< by its sides; empty if convex
  std::vector<int> triangles;                             ///< of the coarse mesh
  double length = 0., sewn_length = 0., edge_length = 0.; ///< of the outline, sewn, of edges [m]
};

/// A fine vertex, which lies between three vertices of a cell, or is an image of the first.
struct PanelPoint
{
  Eigen::RowVector2d point, inside; ///< its place, and one beside it that is not on the outline
  std::array<int, 3> corners;
  Eigen::RowVector3d weights; ///< barycentric
};

/// That of a sheet, without triangles.
Panel panel_of(const meshes::Sheet &sheet);
PanelPoint point_of(const meshes::Sheet &sheet, int vertex);
} // namespace homespun::localization
