// SPDX-License-Identifier: MIT
// Where a term that acts in each triangle by itself, a membrane or a variant of it, finds its
// blocks in the matrix of a cloth.
#pragma once

#include "meshes/plain/triangle_mesh.h"
#include "shell/algebra/block_matrix.h"

#include <array>
#include <vector>

namespace homespun::shell
{
/// Places of the corners (0,0) (0,1) (0,2) (1,1) (1,2) (2,2) of a triangle.
using TriangleSlots = std::array<BlockMatrix::Slot, 6>;

/// Adds the sides of all triangles to the pairs of vertices that are coupled.
inline void couple_corners(const meshes::Triangles &triangles,
                           std::vector<std::array<int, 2>> &pairs)
{
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      pairs.push_back({triangles(t, k), triangles(t, (k + 1) % 3)});
}

/// @return (m) of a matrix with these couplings
inline std::vector<TriangleSlots> places_of(const meshes::Triangles &triangles,
                                            const BlockMatrix &matrix)
{
  std::vector<TriangleSlots> places(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0, b = 0; k < 3; ++k)
      for (int l = k; l < 3; ++l, ++b)
        places[static_cast<std::size_t>(t)][static_cast<std::size_t>(b)] =
          matrix.slot(triangles(t, k), triangles(t, l));
  return places;
}
} // namespace homespun::shell
