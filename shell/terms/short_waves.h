// SPDX-License-Identifier: MIT
// Whether a cloth waves in steps that its mesh cannot follow: of fewer than eight sides.
//
// The angles at the edges, summed up at the vertices, are mean curvatures, b_v = ½ Σ_e |e| θ_e.
// Around a place the sum
//   C(r) = Σ_v b_v Σ_u b_u,   u no farther from v than r at rest,
// is positive where the cloth bends one way. Of waves of length λ, all as long, the inner sum is in
// the mean 2 J1(2πr/λ)/(2πr/λ) of what it is without sign, of which r = 0.61 λ is the first zero:
// the first zero of C tells λ, in whatever direction the wave runs. A roll or a fold has none, a
// saddle no mean curvature.
//
// Vertices count that have as much bend about them as the cloth has in the mean. Limits. A seam
// counts as an outline. Of a cone, whose curvature is that of one vertex, nothing is said; a bump
// that is narrower than three sides is a wave.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/terms/edge_plates.h"

#include <array>
#include <vector>

namespace homespun::shell
{
class ShortWaves
{
public:
  /// In sides of the mesh: those of squares of two mean triangles.
  static constexpr double longest = 8.;

  explicit ShortWaves(const meshes::ClothMesh &mesh);

  /// The length of the shortest waves, in sides; infinite where none is below `longest`, or none
  /// turns the cloth by a degree per side.
  /// @param positions of the vertices in space (n,3) [m]
  double shortest(const meshes::SpacePoints &positions) const;

  /// [m]
  double side() const
  {
    return mean_side;
  }

private:
  struct Neighbour
  {
    int vertex, ring; ///< at rest; distance in parts of a side
  };

  void find_edges(const meshes::ClothMesh &mesh);
  void find_neighbours(const meshes::ClothMesh &mesh);
  double length_around(int vertex, const Eigen::MatrixXd &products) const;

  meshes::Triangles triangles;
  double mean_side = 0.;
  std::vector<PlateEdge> edges;               ///< between two triangles of a panel
  std::vector<std::array<int, 2>> ends;       ///< of each, at rest
  std::vector<double> lengths;                ///< of each [m]
  std::vector<std::vector<Neighbour>> within; ///< 0.61 · 8 sides of each vertex, at rest
};
} // namespace homespun::shell
