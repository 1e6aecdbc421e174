// SPDX-License-Identifier: MIT
// The curved surface through the vertices of a coarse cloth in space, which bends between them,
// too. From the rest and the current coarse mesh alone; no stiffness is needed.
//
//   x(X) = sum_k l_k x_k + n (−½ sum_(i<j) l_i l_j kappa(e_ij)),   kappa(e) = e.K e,   n = sum_k
//   l_k n_k
//
// l_k: barycentric coordinates at rest in a coarse triangle, e_ij: its edges at rest. What is added
// is the quadric of curvature K along the normal; K and n are linear between the vertices, so that
// the surface has no jumps. K_ab = n.x_,ab, positive where the cloth bends towards its normal, in
// the rest frame (11, 22, 2 x 12), n = x_,1 × x_,2 / J: the derivatives of the quadratic polynomial
// that fits the neighbours of a vertex best, x_v fixed, each equation divided by the square of the
// distance at rest. They are neighbours over one edge, and over two or three where those do not
// determine it, as at edges of the cloth. It is exact for quadratic x on any mesh; the mean of
// angles at edges is not.
//
// For coarse vertices on a smooth surface: the distance from it falls with the fourth power of the
// coarse side H where it bends evenly, else the third (flat triangles: the second, kappa H²/8), the
// error of n with the square at least (first). In-plane parts of x_,ab, gradients of strain, are
// left to the coarse triangles: a cloth that lies in a plane stays as it is, to the bit.
#pragma once

#include "localization/options.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::localization
{
class CoarseSurface
{
public:
  /// Numbers of a vertex in a row of values(): K (3) [1/m] and n (3).
  static constexpr int n_components = 6;
  using Values = Eigen::Matrix<double, Eigen::Dynamic, n_components, Eigen::RowMajor>;

  /// Vertices whose neighbours do not determine a quadric have K = 0, those of fewer than three n
  /// = 0, too.
  /// @param space_of_rest vertex in space of each vertex at rest: at edges of panels that are sewn,
  ///   n is the mean of the panels', and nothing is added along the edge, so that no seam opens.
  ///   Empty: each its own
  explicit CoarseSurface(const meshes::TriangleMesh &rest,
                         const std::vector<int> &space_of_rest = {});

  /// Numbers of the vertices. Writes into work space of the object: one thread at a time.
  /// @param current (n,3) by vertex at rest [m], finite
  /// @return (n, n_components), valid until the next call; K is zero, to the bit, where it is
  /// within
  ///   the rounding of the positions, K and n where the cloth is collapsed
  const Values &values(PositionsOf<3> current) const;

  /// Whether any K was not zero in the last values().
  bool is_bent() const
  {
    return bent;
  }

  /// What multiplies K (11, 22, 2 x 12) along the normal at a place in a triangle [m^2].
  /// @param weights barycentric
  Eigen::RowVector3d quadric(int triangle, const Eigen::Vector3d &weights) const;

private:
  /// Derivatives x_,1, x_,2, x_,11, x_,22, 2 x_,12 by the difference to a neighbour, padded.
  struct Neighbour
  {
    int vertex;
    std::array<double, 8> share;
  };

  void add_vertex(int vertex, const std::vector<std::vector<int>> &adjacent);
  bool fit(int vertex, std::vector<int> ring, int n_terms, double tolerance);
  void find_seams(const std::vector<int> &space_of_rest);

  meshes::TriangleMesh mesh;
  std::vector<std::array<bool, 3>> is_sewn; ///< by triangle, the edge opposite to each corner
  std::vector<std::vector<int>> copies;     ///< vertices at rest that are one in space
  std::vector<int> first;                   ///< of the neighbours of a vertex
  std::vector<double> reach;                ///< square of the largest distance of these [m^2]
  std::vector<Neighbour> neighbours;
  mutable Values rows;
  mutable bool bent = false;
};
} // namespace homespun::localization
