// SPDX-License-Identifier: MIT
// A mesh cut into parts, one for each rank, and its nodes numbered part after part. Every rank
// knows the whole mesh and comes to the same answer, so that none asks another.
#pragma once

#include "meshes/plain/triangle_mesh.h"
#include "meshes/plain/triangle_sides.h"

#include <vector>

namespace homespun::homogenization
{
/// The part of each triangle: as many parts as ranks, of equal size to one triangle, by cuts across
/// the longer side of the box of their centres.
std::vector<unsigned int> parts_of(const meshes::TriangleMesh &mesh, unsigned int n_parts);

/// Nodes are vertices, and for P2 midpoints of sides. A node belongs to the first part that has a
/// triangle with it; those of a part follow one another, in the order in which its triangles come
/// to them, corners before midpoints.
struct NodeNumbers
{
  /// @param order 1 or 2
  NodeNumbers(const meshes::TriangleMesh &mesh, const meshes::TriangleSides &sides,
              unsigned int order, const std::vector<unsigned int> &parts, unsigned int n_parts);

  unsigned int n() const
  {
    return begin_of_part.back();
  }

  std::vector<unsigned int> of_vertex;     ///< (vertices)
  std::vector<unsigned int> of_side;       ///< (sides) for P2, else empty
  std::vector<unsigned int> begin_of_part; ///< (n_parts + 1)
};
} // namespace homespun::homogenization
