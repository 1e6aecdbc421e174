// SPDX-License-Identifier: MIT
// A cloth: panels at rest in the plane, sewn together and placed in space. The rest coordinates are
// what an OBJ file calls `vt`, in metres; along a seam two rest vertices share one vertex in space.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

namespace homespun::meshes
{
/// Points in space, one per row, shape (n,3) [m].
using SpacePoints = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Triangle t has the rest corners rest.triangles.row(t), and the corners triangles.row(t) in
/// space, in the same order.
struct ClothMesh
{
  TriangleMesh rest;     ///< all panels in one plane, (n_rest,2) [m]; material is free for phases
  SpacePoints positions; ///< (n,3) where the cloth begins [m]
  Triangles triangles;   ///< (m,3) vertices in space

  int n_vertices() const
  {
    return static_cast<int>(positions.rows());
  }
  int n_triangles() const
  {
    return static_cast<int>(triangles.rows());
  }
};

/// A flat sheet without seams: rest vertices and vertices in space are the same.
/// @param placement (3,2): x = placement X + origin, columns orthonormal [-]
/// @param origin where the rest point zero comes to lie [m]
ClothMesh placed_sheet(const TriangleMesh &rest, const Eigen::Matrix<double, 3, 2> &placement,
                       const Eigen::RowVector3d &origin);
} // namespace homespun::meshes
