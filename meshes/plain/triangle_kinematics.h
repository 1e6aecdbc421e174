// SPDX-License-Identifier: MIT
// How a triangle with linear shape functions deforms, in the plane or in space.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>

namespace homespun::meshes
{
/// The sides of a triangle from its first corner, one per column, (dim,2).
/// @param corners indices of the rows of `points`
/// @param points (n,dim) [m]
template <int dim>
Eigen::Matrix<double, dim, 2>
sides_of_triangle(const Eigen::RowVector3i &corners,
                  const Eigen::Matrix<double, Eigen::Dynamic, dim, Eigen::RowMajor> &points)
{
  Eigen::Matrix<double, dim, 2> sides;
  for (int k = 0; k < 2; ++k)
    sides.col(k) = (points.row(corners(k + 1)) - points.row(corners(0))).transpose();
  return sides;
}

/// A triangle at rest and the functions that are linear on it.
struct TriangleGeometry
{
  double area = 0.;                            ///< [m^2], negative where it runs clockwise
  Eigen::Matrix<double, 3, 2> shape_gradients; ///< row k: gradient of the hat of corner k [1/m]
};

/// @param sides from the first corner, one per column [m]
inline TriangleGeometry triangle_geometry(const Eigen::Matrix2d &sides)
{
  const double doubled = sides(0, 0) * sides(1, 1) - sides(1, 0) * sides(0, 1);
  TriangleGeometry of;
  of.area = 0.5 * doubled;
  of.shape_gradients.row(1) << sides(1, 1) / doubled, -sides(0, 1) / doubled;
  of.shape_gradients.row(2) << -sides(1, 0) / doubled, sides(0, 0) / doubled;
  of.shape_gradients.row(0) = -(of.shape_gradients.row(1) + of.shape_gradients.row(2));
  return of;
}

/// F = dx/dX of a triangle of a mesh, (dim,2): sides now times the inverse of the sides at rest.
/// @param positions of the vertices (n,dim) [m]
template <int dim>
Eigen::Matrix<double, dim, 2>
deformation_gradient(const TriangleMesh &rest, const int triangle,
                     const Eigen::Matrix<double, Eigen::Dynamic, dim, Eigen::RowMajor> &positions)
{
  const Eigen::RowVector3i corners = rest.triangles.row(triangle);
  return sides_of_triangle<dim>(corners, positions) *
         sides_of_triangle<2>(corners, rest.vertices).inverse();
}

/// R of F = R U in the plane, the proper rotation nearest to F; the identity where F = 0.
inline Eigen::Matrix2d nearest_rotation(const Eigen::Matrix2d &F)
{
  const double angle = std::atan2(F(1, 0) - F(0, 1), F(0, 0) + F(1, 1));
  Eigen::Matrix2d R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R;
}
} // namespace homespun::meshes
