// SPDX-License-Identifier: MIT
#include "verification/method/edge_terms.h"

#include "meshes/plain/errors.h"
#include "verification/method/bulk_forces.h"

namespace homespun::verification
{
namespace
{
localization::UpsamplerOptions options_of(const Law law)
{
  localization::UpsamplerOptions options;
  if (law == Law::linear)
  {
    options.strain = localization::Strain::linear;
    options.lift   = localization::Lift::identity;
  }
  return options;
}

/// The middle of an edge, in fractions of the sheet.
Eigen::RowVector2d middle_of(const int side)
{
  Eigen::RowVector2d fraction(0.5, 0.5);
  fraction(meshes::axis_of_side(side)) = meshes::is_far_side(side) ? 1. : 0.;
  return fraction;
}

using Row7 = FrameRow<2>;
} // namespace

EdgeTerms::EdgeTerms(const CellModel &of, const meshes::Sheet &sheet, const Load &load,
                     CoarseGrid of_grid, const Law law)
    : grid(std::move(of_grid))
    , law(law)
    , edges(*of.edges)
    , fitted(of.fitted)
    , sheet(sheet)
    , frames(grid.mesh, options_of(law))
{
  if (load.is_periodic())
    throw meshes::BadInput("terms of edges: load " + load.name +
                           " is one of an infinite cloth, which has no edges; expected strip-1, "
                           "strip-2 or shear-frame");
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
    is_clamped[static_cast<std::size_t>(side)] = load.holds(middle_of(side));
}

EdgeTerms::MacroLoads EdgeTerms::macro_loads(const Positions &positions) const
{
  const auto &of_vertices = frames.values(positions);
  auto of_chi             = of_vertices;
  if (fitted != nullptr)
  {
    const meshes::FittedResponse response(*fitted);
    for (Eigen::Index v = 0; v < of_chi.rows(); ++v)
    {
      const Eigen::Vector3d strain = of_chi.row(v).head<3>();
      of_chi.row(v).head<3>()      = response.at(strain).head<3>();
    }
  }
  MacroLoads loads = {Positions::Zero(grid.mesh.n_vertices(), 2),
                      bulk_forces<2>(grid.mesh, edges.bulk, of_vertices)};
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
    add_side(side, is_clamped[static_cast<std::size_t>(side)] ? of_chi : of_vertices, loads);
  return loads;
}

/// Slip of a clamped edge; of a free one −integral T_a E_a t . dv/ds ds.
void EdgeTerms::add_side(
  const int side, const Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> &of_vertices,
  MacroLoads &loads) const
{
  const int axis               = meshes::axis_of_side(side);
  const meshes::CellEdge &edge = edges.sides[static_cast<std::size_t>(side)];
  const int n                  = axis == 0 ? grid.n2 : grid.n1;
  const int across             = axis == 0 ? grid.n1 : grid.n2;
  const int fixed              = meshes::is_far_side(side) ? across : 0;
  const auto vertex            = [&](const int k)
  { return axis == 0 ? k * (grid.n1 + 1) + fixed : fixed * (grid.n1 + 1) + k; };
  if (is_clamped[static_cast<std::size_t>(side)])
  {
    for (int k = 0; k <= n; ++k)
    {
      const Row7 frame = of_vertices.row(vertex(k));
      loads.slip.row(vertex(k)) =
        (lift_of<2>(frame) * edge.slip * frame.head<3>().transpose()).transpose();
    }
    return;
  }
  const Eigen::Vector2d along = sheet.lattice.vectors.row(1 - axis).transpose().normalized();
  for (int k = 0; k < n; ++k)
  {
    const Row7 frame = 0.5 * (of_vertices.row(vertex(k)) + of_vertices.row(vertex(k + 1)));
    const Eigen::RowVector2d pull =
      frame.head<3>().dot(edge.tension.transpose()) * (lift_of<2>(frame) * along).transpose();
    loads.forces.row(vertex(k)) += pull;
    loads.forces.row(vertex(k + 1)) -= pull;
  }
}

void EdgeTerms::give_edges(localization::UpsamplerOptions &options) const
{
  options.edges = &edges;
  for (std::size_t side = 0; side < is_clamped.size(); ++side)
    options.edge_kinds[side] =
      is_clamped[side] ? localization::EdgeKind::clamped : localization::EdgeKind::free;
}

shell::Equilibrium<2> with_edges(const EdgeTerms &terms, const CoarseSpace &space,
                                 const CoarseSolver &solver, const EdgeTerms::Positions &positions)
{
  const EdgeTerms::MacroLoads loads = terms.macro_loads(space.on_grid<2>(positions));
  const EdgeTerms::Positions slip   = space.at_nodes(loads.slip),
                             forces = space.loads_of_nodes<2>(loads.forces);
  if (terms.law == Law::linear)
  {
    const meshes::Points &rest = space.nodes.mesh.vertices;
    shell::Equilibrium<2> result;
    result.positions  = positions + (solver.solve_linear(rest + slip, forces) - rest);
    result.iterations = 1;
    return result;
  }
  return solver.solve_equilibrium(terms.law, positions + slip, forces);
}

std::string sentence_of_edges(const meshes::CellEdges &edges, const Load &load)
{
  std::string clamped, free;
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    std::string &list = load.holds(middle_of(side)) ? clamped : free;
    list += std::string(list.empty() ? "" : " and ") + "axis " +
            std::to_string(meshes::axis_of_side(side) + 1) +
            (meshes::is_far_side(side) ? ", far end (" : ", near end (") +
            std::to_string(edges.sides[static_cast<std::size_t>(side)].n_cells) + " cells)";
  }
  return "all edges of the sheet are lattice lines and have their terms; clamped, "
         "with slip and modes: " +
         clamped + "; free, with tension and modes: " + free;
}
} // namespace homespun::verification
