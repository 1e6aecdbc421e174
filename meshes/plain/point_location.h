// SPDX-License-Identifier: MIT
// Which triangle holds a point of the rest plane: a uniform grid over the triangles' boxes, about
// one triangle per bucket, so that a query costs a handful of them. Used once, at set-up.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::meshes
{
/// A point in a triangle.
struct Location
{
  int triangle            = -1;                      ///< −1: outside the mesh
  Eigen::Vector3d weights = Eigen::Vector3d::Zero(); ///< barycentric coordinates, their sum is 1
};

class PointLocation
{
public:
  /// Sorts the triangles into the grid.
  explicit PointLocation(const TriangleMesh &mesh);

  /// The same with some of the triangles only, such as those of one panel.
  PointLocation(const TriangleMesh &mesh, const std::vector<int> &some_triangles);

  /// The triangle that holds a point. A point counts as inside a triangle where its barycentric
  /// coordinates are above −1e-6, which is what files with eight digits need.
  /// @param point [m]
  /// @param towards small vector [m]: where several triangles hold the point, the one that holds
  ///   point + towards best is taken, and the first of these
  Location locate(const Eigen::RowVector2d &point, const Eigen::RowVector2d &towards) const;

private:
  Eigen::Vector3d weights(int triangle, const Eigen::RowVector2d &point) const;
  int bucket(double coordinate, int axis) const;

  TriangleMesh mesh;
  Eigen::RowVector2d low, width; ///< lower-left corner of the grid, size of a bucket [m]
  int n_buckets[2] = {1, 1};
  std::vector<int> first, members; ///< triangles of each bucket
};
} // namespace homespun::meshes
