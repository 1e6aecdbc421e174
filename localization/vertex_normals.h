// SPDX-License-Identifier: MIT
// Normals of a surface for who draws it: computed when asked for, never otherwise.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace homespun::localization
{
/// Unit normals at the vertices: the mean over their triangles, weighted by area, n_v ~ sum of e1 x
/// e2.
/// @param positions (n,3) [m]
/// @param triangles (m,3); with meshes::FineCloth::sewn_triangles() normals are smooth across seams
///   (copy the row of same_in_space to the others)
/// @return (n,3); zero at a vertex whose triangles have no area, or that has none
template <typename Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor>
vertex_normals(const Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor> &positions,
               const meshes::Triangles &triangles)
{
  using Vector = Eigen::Matrix<Scalar, 1, 3>;
  Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor> normals;
  normals.setZero(positions.rows(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    const Vector x0 = positions.row(triangles(t, 0)), e1 = positions.row(triangles(t, 1)) - x0,
                 e2 = positions.row(triangles(t, 2)) - x0, normal = e1.cross(e2);
    for (int k = 0; k < 3; ++k)
      normals.row(triangles(t, k)) += normal;
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v)
    if (const Scalar largest = normals.row(v).cwiseAbs().maxCoeff(); largest > Scalar(0))
    {
      // First to size one: the squares of a fine triangle's area underflow in float.
      normals.row(v) /= largest;
      normals.row(v).normalize();
    }
  return normals;
}
} // namespace homespun::localization
