// SPDX-License-Identifier: MIT
// The sides of the triangles of a mesh, each once: what midpoints are counted by.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::meshes
{
struct TriangleSides
{
  /// Side k of a triangle runs from its corner k to corner k + 1; two triangles have a side in
  /// common where they have its corners. Numbered as the triangles come to them, in time and memory
  /// that grow as their number.
  explicit TriangleSides(const TriangleMesh &mesh);

  int n() const
  {
    return static_cast<int>(n_triangles.size());
  }

  Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor> of_triangle;
  std::vector<int> n_triangles; ///< of each side: one on the boundary
};
} // namespace homespun::meshes
