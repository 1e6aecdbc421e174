// SPDX-License-Identifier: MIT
#include "localization/panel_edges.h"

namespace homespun::localization
{
Panel panel_of(const meshes::Sheet &sheet)
{
  Panel panel = {sheet.origin, {0., 0.}, Eigen::RowVector2d(sheet.n1, sheet.n2), {}, {}, {}, {}};
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    const int axis = meshes::axis_of_side(side);
    panel.edges.push_back({side,
                           meshes::is_far_side(side) ? (axis == 0 ? sheet.n1 : sheet.n2) : 0,
                           {0., panel.high(1 - axis)},
                           {true, true}});
  }
  return panel;
}

PanelPoint point_of(const meshes::Sheet &sheet, const int vertex)
{
  const Eigen::RowVector2d n(sheet.n1, sheet.n2),
    point     = sheet.fraction(sheet.mesh.vertices.row(vertex)).cwiseProduct(n);
  const int v = sheet.cell_vertex(vertex);
  return {point, point + 1e-3 * (n / 2. - point), {v, v, v}, {1., 0., 0.}};
}
} // namespace homespun::localization
