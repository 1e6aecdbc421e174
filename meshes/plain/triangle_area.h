// SPDX-License-Identifier: MIT
// Which triangle counts as one without area: one limit for cells, panels, surfaces, membranes and
// hinges, in which neither unit nor place nor direction of a triangle has a part.
//
// Corners that are rounded to doubles leave twice the area with an error of some 4 eps l^2, l the
// longest edge, and with it the gradients of the shape functions, hence every strain, with a
// relative one of
//   4 eps l^2 / (2 A) = 4 eps / q,   q = 2 A / l^2,
// the height over the longest edge. At q = 1e-9 that is 1e-6, the smallest strain that is asked for
// anywhere: a flatter triangle has none that means anything.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace homespun::meshes
{
/// Of a triangle in the plane or in space.
struct TriangleArea
{
  double area;         ///< in the plane negative where it is clockwise [m^2]
  double longest_edge; ///< [m]

  /// Height over the longest edge, 2 A / l^2 [-]: at most sqrt(3)/2; 0 where all corners are one.
  double height() const
  {
    return longest_edge > 0. ? 2. * area / (longest_edge * longest_edge) : 0.;
  }
  /// Whether it has an area, of either sign; false where a corner is not a number.
  bool is_there() const
  {
    return std::abs(height()) > 1e-9;
  }
};

/// @param corners (3,2) or (3,3) [m]
template <int dim>
TriangleArea triangle_area(const Eigen::Matrix<double, 3, dim> &corners)
{
  const Eigen::Matrix<double, 1, dim> a = corners.row(1) - corners.row(0),
                                      b = corners.row(2) - corners.row(0);
  double doubled;
  if constexpr (dim == 2)
    doubled = a(0) * b(1) - a(1) * b(0);
  else
    doubled = a.cross(b).norm();
  return {0.5 * doubled, std::max({a.norm(), b.norm(), (b - a).norm()})};
}

/// The same of a triangle of a mesh.
/// @param points (n,dim) [m]
/// @param triangle its three vertices
template <int dim>
TriangleArea
triangle_area(const Eigen::Matrix<double, Eigen::Dynamic, dim, Eigen::RowMajor> &points,
              const Eigen::RowVector3i &triangle)
{
  Eigen::Matrix<double, 3, dim> corners;
  for (int k = 0; k < 3; ++k)
    corners.row(k) = points.row(triangle(k));
  return triangle_area<dim>(corners);
}
} // namespace homespun::meshes
