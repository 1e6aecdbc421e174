// SPDX-License-Identifier: MIT
// The curvature of a homogenized sheet along an edge, as the mean over the width of a cell. Beside
// a corner between a clamped and a free edge it is singular; what lifts a clamp by its size at each
// point would have no finite energy there, and a cell does not feel it so closely.
#pragma once

#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::verification
{
class EdgeMeans
{
public:
  /// @param edge 0 to 3, as in meshes::CellEdges
  EdgeMeans(const meshes::Sheet &sheet, int edge);

  /// A side of the mesh on the edge and the curvature there, 11, 22, 2 12.
  void add(const std::array<Eigen::Vector2d, 2> &ends, const Eigen::Vector3d &curvature);

  /// The mean over what lies within half a cell along the edge.
  Eigen::Vector3d at(const Eigen::Vector2d &point) const;

private:
  struct Side
  {
    double begin, end; ///< along the edge [m]
    Eigen::Vector3d curvature;
  };

  Eigen::Vector2d along; ///< of length 1
  double half_cell;      ///< [m]
  std::vector<Side> sides;
};
} // namespace homespun::verification
