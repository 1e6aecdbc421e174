// SPDX-License-Identifier: MIT
// The Hsieh-Clough-Tocher triangle: piecewise cubic on the three triangles that join the sides to
// the centroid, once continuously differentiable inside and across sides. Its second derivatives
// are the stresses of the complementary energy (Airy's function) and the curvatures of a plate.
// Source: R. W. Clough and J. L. Tocher, 1965; ordinates as in G. Farin, Triangular
// Bernstein-Bezier patches, CAGD 3 (1986).
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::homogenization
{
/// The 12 shape functions of one triangle, by their Bezier ordinates.
///
/// Degrees of freedom, in this order: value, d/dx, d/dy at each vertex; the derivative along the
/// given normal at the middle of each side (side k joins the vertices k and k + 1). All cubics are
/// in the space, hence errors O(h^4) in value and O(h^2) in the second derivatives.
class CloughTocher
{
public:
  using Row = Eigen::Matrix<double, 1, 12>;

  /// @param vertices corners, counter-clockwise [m]
  /// @param normals unit normals of the sides, in whichever of their two directions the neighbour
  ///   agrees on
  CloughTocher(const std::array<Eigen::Vector2d, 3> &vertices,
               const std::array<Eigen::Vector2d, 3> &normals);

  /// Value, d/dx and d/dy of all shape functions, rows 0, 1, 2.
  /// @param piece triangle of the vertices (piece, piece + 1, centroid)
  /// @param barycentric coordinates in that triangle
  Eigen::Matrix<double, 3, 12> value_and_gradient(int piece,
                                                  const Eigen::Vector3d &barycentric) const;

  /// d2/dx2, d2/dy2 and d2/dxdy of all shape functions, rows 0, 1, 2; linear within a piece.
  Eigen::Matrix<double, 3, 12> second_derivatives(int piece,
                                                  const Eigen::Vector3d &barycentric) const;

  /// second_derivatives() at the three corners of a piece, between which they are linear.
  std::array<Eigen::Matrix<double, 3, 12>, 3> second_derivatives_at_corners(int piece) const;

private:
  /// The ordinate of a piece with the given powers of its three barycentric coordinates, sum 3.
  const Row &ordinate(int piece, std::array<int, 3> powers) const;

  std::array<Row, 3> corners, spokes, inner,
    middles; ///< at vertices, 1/3 and 2/3 of the way to the centroid, of the sides
  std::array<std::array<Row, 2>, 3> sides; ///< at 1/3 and 2/3 of each side
  Row centre;
  /// Gradients of the barycentric coordinates of each piece, one per column.
  std::array<Eigen::Matrix<double, 2, 3>, 3> gradients;
};

/// Barycentric coordinates, in its piece and in the triangle, of a point of a triangle.
struct PiecePoint
{
  int piece;
  Eigen::Vector3d in_piece, in_triangle;
};

/// A point and its part of the area.
struct WeightedPoint
{
  PiecePoint point;
  double weight;
};

/// Gauss's points on lines from the centroid to the sides, n along each and n lines in each piece:
/// exact to degree 2 n − 2 in each.
std::vector<WeightedPoint> points_of_pieces(int n);
} // namespace homespun::homogenization
