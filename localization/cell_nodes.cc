// SPDX-License-Identifier: MIT
#include "localization/cell_nodes.h"

#include <algorithm>
#include <cmath>

namespace homespun::localization
{
namespace
{
/// A coarse mesh is a lattice if its vertices agree to this part of the cell size. Far below
/// image_tolerance: what agrees less well is up-sampled by the general path, right to all digits.
constexpr double aligned_tolerance = 1e-10;
} // namespace

int quads_per_cell(const meshes::Sheet &sheet, const meshes::TriangleMesh &coarse)
{
  for (const int r : {1, 2})
  {
    if (coarse.n_triangles() != 2 * r * r * sheet.n1 * sheet.n2)
      continue;
    const meshes::TriangleMesh lattice =
      meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors / r, r * sheet.n1, r * sheet.n2);
    if (coarse.n_vertices() == lattice.n_vertices() && coarse.triangles == lattice.triangles &&
        (coarse.vertices - lattice.vertices).cwiseAbs().maxCoeff() <=
          aligned_tolerance * std::sqrt(sheet.lattice.area()))
      return r;
  }
  return 0;
}

std::array<int, 6> nodes_of_triangle(const int quads, const int n1, const int i, const int j,
                                     const Half half)
{
  const int up = quads * n1 + 1, origin = quads * (j * up + i),
            opposite  = origin + quads * (up + 1);
  const bool is_above = half == Half::above;
  const int off       = origin + quads * (is_above ? up : 1); // the corner off the diagonal
  const int first = is_above ? opposite : off, second = is_above ? off : opposite;
  return {origin, first, second, (origin + first) / 2, (first + second) / 2, (origin + second) / 2};
}

Eigen::Vector3d weights_in_cell(const meshes::Sheet &sheet, const int vertex)
{
  // s along a1 and t along a2: below, corners (0,0) (1,0) (1,1); above, (0,0) (1,1) (0,1).
  const Eigen::RowVector2d f =
    sheet.lattice.fractional(sheet.mesh.vertices.row(vertex) - sheet.origin);
  const double s = f(0), t = f(1);
  return vertex < sheet.n_below ? Eigen::Vector3d(1. - s, s - t, t)
                                : Eigen::Vector3d(1. - t, s, t - s);
}

Eigen::Vector3d hats(const Eigen::Vector3d &weights)
{
  Eigen::Vector3d result;
  for (int side = 0; side < 3; ++side)
  {
    const double a = weights(side % 2 == 0 ? 0 : 1), b = weights(side == 0 ? 1 : 2),
                 opposite = weights(side == 0   ? 2
                                    : side == 1 ? 0
                                                : 1);
    result(side)          = std::max(0., std::min({2. * a, 2. * b, 1. - 2. * opposite}));
  }
  return result;
}
} // namespace homespun::localization
