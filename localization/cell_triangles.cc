// SPDX-License-Identifier: MIT
#include "localization/cell_triangles.h"

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

std::vector<CellTriangle> triangles_of_cell(const meshes::Sheet &sheet, const int quads)
{
  const auto &begin = sheet.begin_of_eighth;
  if (quads == 1)
    return {{{0, 0, false}, 0, begin[4]}, {{0, 0, true}, begin[4], sheet.n_per_cell}};
  std::vector<CellTriangle> all;
  for (std::size_t k = 0; k < meshes::eighths_of_cell.size(); ++k)
    all.push_back({meshes::eighths_of_cell[k], begin[k], begin[k + 1]});
  return all;
}

int coarse_triangle(const meshes::QuadHalf &in_cell, const int quads, const int n1, const int i,
                    const int j)
{
  const int quad1 = quads * i + in_cell.quad1, quad2 = quads * j + in_cell.quad2;
  return 2 * (quad2 * quads * n1 + quad1) + (in_cell.is_above ? 1 : 0);
}

Eigen::Vector3d weights_in(const meshes::QuadHalf &in_cell, const int quads,
                           const meshes::Sheet &sheet, const int vertex)
{
  // s along a1 and t along a2: below, corners (0,0) (1,0) (1,1); above, (0,0) (1,1) (0,1).
  const Eigen::RowVector2d f =
    quads * sheet.lattice.fractional(sheet.mesh.vertices.row(vertex) - sheet.origin);
  const double s = f(0) - in_cell.quad1, t = f(1) - in_cell.quad2;
  return in_cell.is_above ? Eigen::Vector3d(1. - t, s, t - s) : Eigen::Vector3d(1. - s, s - t, t);
}
} // namespace homespun::localization
