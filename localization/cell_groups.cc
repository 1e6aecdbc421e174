// SPDX-License-Identifier: MIT
#include "localization/cell_groups.h"

#include "localization/kernel.h"

#include <algorithm>
#include <cmath>

namespace homespun::localization
{
namespace
{
/// A coarse mesh is a lattice if its vertices agree to this part of the cell size. Far below
/// image_tolerance: what agrees less well is up-sampled by the general path, right to all digits.
constexpr double aligned_tolerance = 1e-10;
constexpr int most_quads           = 4;
} // namespace

int quads_per_cell(const meshes::Sheet &sheet, const meshes::TriangleMesh &coarse)
{
  for (int r = 1; r <= most_quads; ++r)
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

CellGroups cell_groups(const meshes::Sheet &sheet, const int r)
{
  CellGroups result;
  result.r = r;
  for (int j = 0; j < r; ++j)
    for (int i = 0; i < r; ++i)
      for (const bool is_above : {false, true})
        result.groups.push_back({i, j, is_above, 0, {}, {}});
  for (int k = 0; k < sheet.n_per_cell; ++k)
  {
    const Eigen::RowVector2d f =
      r * sheet.lattice.fractional(sheet.mesh.vertices.row(k) - sheet.origin);
    // A point on a side of a quad belongs to the one above it, but for rounding.
    const auto quad = [&](const double x)
    { return std::clamp(static_cast<int>(std::floor(x + 1e-9)), 0, r - 1); };
    const int i = quad(f(0)), j = quad(f(1));
    const double s = f(0) - i, t = f(1) - j;
    CellGroups::Group &group =
      result.groups[static_cast<std::size_t>(2 * (j * r + i) + (t > s ? 1 : 0))];
    group.vertices.push_back(k);
    group.weights.push_back(t > s ? Eigen::Vector3d(1. - t, s, t - s)
                                  : Eigen::Vector3d(1. - s, s - t, t));
  }
  int slot = 0;
  for (CellGroups::Group &group : result.groups)
  {
    group.first_slot = slot;
    slot += (static_cast<int>(group.vertices.size()) + lanes - 1) / lanes * lanes;
  }
  return result;
}
} // namespace homespun::localization
