// SPDX-License-Identifier: MIT
// The edges of the boundary of a mesh, found by where they are.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <unordered_map>
#include <vector>

namespace homespun::homogenization
{
/// An edge of the boundary and its triangle, which lies to its left.
struct BoundaryEdge
{
  int from, to, apex = -1, triangle = -1;
};

std::vector<BoundaryEdge> edges_of_boundary(const meshes::TriangleMesh &mesh);

/// Edges by the squares of a grid that they may pass, about one in each.
class EdgeGrid
{
public:
  /// @param near how far from an edge its squares reach, in parts of its length
  EdgeGrid(const meshes::TriangleMesh &mesh, const std::vector<BoundaryEdge> &edges, double near);

  /// Those near to a point.
  const std::vector<std::size_t> &around(const Eigen::RowVector2d &x) const;

  const std::unordered_map<long, std::vector<std::size_t>> &squares() const
  {
    return edges_in;
  }

private:
  std::array<int, 2> square_of(const Eigen::RowVector2d &x) const;

  Eigen::RowVector2d low;
  double width;
  std::unordered_map<long, std::vector<std::size_t>> edges_in;
};
} // namespace homespun::homogenization
