// SPDX-License-Identifier: MIT
#include "verification/bend/cell_twice.h"

#include "homogenization/bracket/bending_bracket.h"
#include "meshes/plain/refine.h"
#include "verification/cell/discretization_distance.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
/// A field of a sheet of the refined cell, at the vertices of that of the drawn one.
BentState at_drawn_vertices(const meshes::Sheet &drawn, const meshes::Sheet &refined,
                            const BentState &field)
{
  const auto key = [](const meshes::Sheet &sheet, const int v)
  { return std::tuple(sheet.cell(v, 0), sheet.cell(v, 1), sheet.cell_vertex(v)); };
  std::map<std::tuple<int, int, int>, int> vertex;
  for (int v = 0; v < refined.mesh.n_vertices(); ++v)
    vertex[key(refined, v)] = v;
  BentState found(drawn.mesh.n_vertices(), field.cols());
  for (int v = 0; v < drawn.mesh.n_vertices(); ++v)
    found.row(v) = field.row(vertex.at(key(drawn, v)));
  return found;
}

UnitCell refined_cell(const UnitCell &cell)
{
  UnitCell finer = cell;
  finer.mesh     = meshes::refined(cell.mesh, 1);
  return finer;
}

/// Of the corners of a plate, which are those of its analogous membrane.
double factor_of(const BendingCell &bent)
{
  const auto membranes = homogenization::analogous_membranes(bent.bending_stiffness_of_phase);
  return std::max(safety_unconfirmed, factor_of_bars(order_of_p2(bent.cell, membranes, 2.)));
}
} // namespace

CellTwice::CellTwice(const UnitCell &cell)
    : drawn(cell)
    , refined_unit(refined_cell(cell))
    , finer(refined_unit)
    , factor(factor_of(drawn))
{
}

OptionalErrors distance_of_meshes(const CellTwice &cell, const BendingLoad &load, const int n)
{
  const BentSheet drawn(cell.drawn, load, n, macro_quads_per_cell(n)),
    finer(cell.finer, load, n, macro_quads_per_cell(n));
  return distance_of_errors(drawn.sheet, drawn.error_of_method, finer.sheet, finer.error_of_method);
}

OptionalErrors distance_of_errors(const meshes::Sheet &drawn,
                                  const BentSheet::OfMethods<BentState> &on_drawn,
                                  const meshes::Sheet &refined,
                                  const BentSheet::OfMethods<BentState> &on_refined)
{
  OptionalErrors distances;
  for (std::size_t k = 0; k < distances.size(); ++k)
    if (on_drawn[k].size() > 0 && on_refined[k].size() > 0)
      distances[k] = mean_of(on_drawn[k] - at_drawn_vertices(drawn, refined, on_refined[k]));
  return distances;
}

BentSheet::OfMethods<double> growth_in_linear_theory(const double ratio)
{
  BentSheet::OfMethods<double> growth;
  for (std::size_t k = 0; k < growth.size(); ++k)
    growth[k] = has_edges(bending_methods[k]) ? 1. : ratio;
  return growth;
}

BentSheet::OfMethods<double> growth_at_large_turns(const double ratio)
{
  BentSheet::OfMethods<double> growth;
  growth.fill(ratio);
  return growth;
}

OptionalErrors carried_bars(const OptionalErrors &distances,
                            const BentSheet::OfMethods<double> &growth, const double factor)
{
  OptionalErrors bars = distances;
  for (std::size_t k = 0; k < bars.size(); ++k)
    if (bars[k])
      *bars[k] = {factor * growth[k] * bars[k]->position, factor * bars[k]->normal};
  return bars;
}
} // namespace homespun::verification
