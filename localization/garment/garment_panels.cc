// SPDX-License-Identifier: MIT
#include "localization/garment/garment_panels.h"

#include "meshes/cloth/seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

namespace homespun::localization
{
namespace
{
constexpr double tolerance = meshes::outline_tolerance; // [cells]

/// Joins what lies on one line without a gap, and marks corners.
std::vector<PanelEdge> joined(std::vector<PanelEdge> sides)
{
  std::sort(sides.begin(), sides.end(),
            [](const PanelEdge &a, const PanelEdge &b)
            { return std::tie(a.side, a.line, a.ends) < std::tie(b.side, b.line, b.ends); });
  std::vector<PanelEdge> edges;
  for (const PanelEdge &next : sides)
    if (!edges.empty() && edges.back().side == next.side && edges.back().line == next.line &&
        next.ends[0] <= edges.back().ends[1] + tolerance)
      edges.back().ends[1] = std::max(edges.back().ends[1], next.ends[1]);
    else
      edges.push_back(next);
  // At a convex corner, or the mouth of a slit, the other edge closes the panel off there.
  for (PanelEdge &edge : edges)
    for (std::size_t end = 0; end < 2; ++end)
      for (const PanelEdge &other : edges)
        if (other.side == 2 * (1 - edge.axis()) + static_cast<int>(end) &&
            std::abs(other.line - edge.ends[end]) <= tolerance &&
            edge.line >= other.ends[0] - tolerance && edge.line <= other.ends[1] + tolerance)
          edge.is_corner[end] = true;
  return edges;
}
} // namespace

meshes::TriangleMesh in_frames_of_cells(const meshes::ClothMesh &coarse,
                                        const std::vector<meshes::Grain> &grains)
{
  meshes::TriangleMesh rest   = coarse.rest;
  const Eigen::VectorXi panel = meshes::panels_of(coarse).of_vertex;
  for (int v = 0; v < rest.n_vertices(); ++v)
    if (const int p = panel(v); p >= 0 && grains[static_cast<std::size_t>(p)].angle != 0.)
      rest.vertices.row(v) =
        (rest.vertices.row(v) * grains[static_cast<std::size_t>(p)].rotation()).eval();
  return rest;
}

std::vector<Panel> garment_panels(const meshes::ClothMesh &coarse, const meshes::FineCloth &fine)
{
  const meshes::Panels membership = meshes::panels_of(coarse);
  const meshes::TriangleMesh rest = in_frames_of_cells(coarse, fine.grains);
  std::vector<Panel> panels(static_cast<std::size_t>(membership.count));
  for (std::size_t p = 0; p < panels.size(); ++p)
  {
    panels[p].zero = fine.grains[p].origin * fine.grains[p].rotation();
    panels[p].low.setConstant(std::numeric_limits<double>::infinity());
    panels[p].high = -panels[p].low;
  }
  for (int t = 0; t < coarse.n_triangles(); ++t)
    panels[static_cast<std::size_t>(membership.of_triangle(t))].triangles.push_back(t);
  std::set<std::pair<int, int>> sewn;
  for (const meshes::SeamEdge &seam : meshes::seam_edges(coarse))
    for (const meshes::Side &side : seam.sides)
      sewn.emplace(side.triangle, side.side);
  for (const meshes::Side &side : meshes::open_sides(coarse))
  {
    Panel &panel = panels[static_cast<std::size_t>(membership.of_triangle(side.triangle))];
    std::array<Eigen::RowVector2d, 3> corner; // the side, then what is inside [cells]
    for (int k = 0; k < 3; ++k)
      corner[static_cast<std::size_t>(k)] = fine.lattice.fractional(
        rest.vertices.row(rest.triangles(side.triangle, (side.side + k) % 3)) - panel.zero);
    const auto &[from, to, inside] = corner;
    const double length            = ((to - from) * fine.lattice.vectors).norm();
    panel.outline.push_back({from, to});
    panel.low  = panel.low.cwiseMin(from);
    panel.high = panel.high.cwiseMax(from);
    panel.length += length;
    if (sewn.count({side.triangle, side.side}) != 0)
    {
      panel.sewn_length += length;
      continue;
    }
    for (int axis = 0; axis < 2; ++axis)
      if (const double line = std::round(from(axis));
          std::abs(from(axis) - line) <= tolerance && std::abs(to(axis) - line) <= tolerance)
      {
        panel.edge_length += length;
        panel.edges.push_back(
          {2 * axis + (inside(axis) < line ? 1 : 0),
           static_cast<int>(line),
           {std::min(from(1 - axis), to(1 - axis)), std::max(from(1 - axis), to(1 - axis))},
           {false, false}});
      }
  }
  for (Panel &panel : panels)
    panel.edges = joined(panel.edges);
  return panels;
}
} // namespace homespun::localization
