// SPDX-License-Identifier: MIT
#include "verification/method/moving_edges.h"

#include "meshes/plain/errors.h"
#include "verification/method/bulk_forces.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace homespun::verification
{
using localization::EdgeKind;

MovingEdges::MovingEdges(const meshes::HomogenizedCell &cell, const meshes::CellEdges &edges,
                         const meshes::Sheet &sheet, const CoarseSpace &of_cloth,
                         const std::vector<int> &held)
    : space(of_cloth)
    , frames(space.grid.mesh, {})
    , bulk(edges.bulk)
    , size_of_bulk(cell.stiffness.norm() * std::sqrt(cell.lattice.area()))
{
  std::vector<bool> is_held(static_cast<std::size_t>(space.nodes.mesh.n_vertices()), false);
  for (const int v : held)
    is_held[static_cast<std::size_t>(v)] = true;
  std::map<int, Eigen::Matrix<double, 2, 3>> slip_of;
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    const auto s      = static_cast<std::size_t>(side);
    const int axis    = meshes::axis_of_side(side);
    const int n       = axis == 0 ? sheet.n2 : sheet.n1;
    const int fixed   = !meshes::is_far_side(side) ? 0 : axis == 0 ? sheet.n1 : sheet.n2;
    const auto vertex = [&](const int k)
    { return axis == 0 ? k * (sheet.n1 + 1) + fixed : fixed * (sheet.n1 + 1) + k; };
    int n_held = 0, n_between = 0;
    for (int k = 0; k <= n; ++k)
      if (is_held[static_cast<std::size_t>(vertex(k))])
      {
        ++n_held;
        n_between += k > 0 && k < n;
      }
    kinds[s] = n_held == n + 1  ? EdgeKind::clamped
               : n_between == 0 ? EdgeKind::free
                                : EdgeKind::none;
    if (kinds[s] == EdgeKind::clamped)
      for (int k = 0; k <= n; ++k)
        slip_of[vertex(k)] = edges.sides[s].slip;
    if (kinds[s] != EdgeKind::free)
      continue;
    const Eigen::Vector2d along = sheet.lattice.vectors.row(1 - axis).transpose();
    const double kappa = shell::selvedge_stiffness(edges.sides[s].tension, cell.stiffness, along);
    const double most =
      shell::largest_push(cell.stiffness, along, cell.lattice.area() / along.norm());
    if (-kappa >= most)
      throw meshes::BadInput("selvedge: edge " + std::to_string(side) +
                             " of the sheet pushes with " + std::to_string(-kappa) +
                             " N per strain; expected less than the " + std::to_string(most) +
                             " N that the coarse triangles behind it bear: leave out the method, "
                             "or cut the cell at another place");
    for (int k = 0; k < n && kappa != 0.; ++k)
      segments.push_back({{vertex(k), vertex(k + 1)}, along.norm(), kappa});
  }
  for (const auto &[node, per_strain] : slip_of)
    slips.push_back({node, per_strain});
}

localization::Positions<3> MovingEdges::slip(const localization::Positions<3> &positions) const
{
  const auto &of_vertices           = frames.values(space.on_grid<3>(positions));
  localization::Positions<3> result = localization::Positions<3>::Zero(positions.rows(), 3);
  for (const Slip &at : slips)
  {
    const FrameRow<3> frame = of_vertices.row(space.grid_vertex(at.node));
    result.row(at.node) =
      (lift_of<3>(frame) * at.per_strain * frame.head<3>().transpose()).transpose();
  }
  return result;
}

bool MovingEdges::has_bulk_forces() const
{
  return std::max(bulk[0].norm(), bulk[1].norm()) > 1e-9 * size_of_bulk;
}

localization::Positions<3>
MovingEdges::bulk_forces(const localization::Positions<3> &positions) const
{
  return space.loads_of_nodes<3>(
    verification::bulk_forces<3>(frames.rest(), bulk, frames.values(space.on_grid<3>(positions))));
}

void MovingEdges::give_edges(const meshes::CellEdges &edges,
                             localization::UpsamplerOptions &options) const
{
  options.edges      = &edges;
  options.edge_kinds = kinds;
}

std::string MovingEdges::sentence() const
{
  std::array<std::string, 3> lists;
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    std::string &list = lists[static_cast<std::size_t>(kinds[static_cast<std::size_t>(side)])];
    list += std::string(list.empty() ? "" : " and ") + "axis " +
            std::to_string(meshes::axis_of_side(side) + 1) +
            (meshes::is_far_side(side) ? ", far end" : ", near end");
  }
  const auto or_none = [](const std::string &list) { return list.empty() ? "none" : list; };
  return "terms of edges: clamped, with slip and modes: " + or_none(lists[1]) +
         "; free, with tension and modes: " + or_none(lists[2]) +
         "; held in part, without terms: " + or_none(lists[0]);
}
} // namespace homespun::verification
