// SPDX-License-Identifier: MIT
#include "verification/strain/claims/layer_checks.h"

#include "meshes/plain/sheet.h"
#include "verification/record/claim.h"
#include "verification/strain/budget/edge_parts.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using meshes::CellEdges;

namespace
{
constexpr double strain = 1e-3; // any: the law is linear
} // namespace

LayeredSheet::LayeredSheet(const homogenization::UnitCell &cell, const CellModel &model,
                           const Load &load, const int n_cells, const int n_quads)
    : of_cell(model)
    , load(load)
    , sheet(meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells))
    , model(of_cell, sheet, load, Method("full"), Law::linear, quads_per_cell(sheet, n_quads))
    , coarse(this->model.on_grid(this->model.solve(strain)))
    , membrane(shell::membrane(sheet.mesh, cell.stiffness_of_phase()))
{
}

EdgeResiduals LayeredSheet::left_by(const CellEdges &edges, const double apart) const
{
  localization::UpsamplerOptions options = model.parts.options;
  options.edges                          = &edges;
  localization::Upsampler<2, double>::Fine fine;
  localization::Upsampler<2, double>(of_cell.cell, model.parts.space.grid.mesh, sheet, options)
    .upsample(coarse, fine);
  const meshes::Points u           = fine - sheet.mesh.vertices;
  const shell::Positions<2> forces = shell::linear_membrane_gradient(membrane, u);
  EdgeResiduals left               = {};
  std::array<int, left.size()> n   = {};
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d at = sheet.fraction(sheet.mesh.vertices.row(v));
    for (std::size_t side = 0; side < left.size(); ++side)
    {
      const int axis     = meshes::axis_of_side(static_cast<int>(side));
      const double along = at(1 - axis);
      if (std::abs(at(axis) - (meshes::is_far_side(static_cast<int>(side)) ? 1. : 0.)) > 1e-9 ||
          std::min(along, 1. - along) < apart - 1e-9)
        continue;
      const double size = axis == load.axis()
                            ? (u.row(v) - load.displacement(at, sheet.sides(), strain)).norm()
                            : forces.row(v).norm();
      left[side].mean += size;
      left[side].largest = larger(left[side].largest, size);
      ++n[side];
    }
  }
  for (std::size_t side = 0; side < left.size(); ++side)
    left[side].mean /= n[side];
  return left;
}

CellEdges without_layers(const CellEdges &edges)
{
  return edges_piece_by_piece(edges)[2];
}

namespace
{
/// What layers leave over what there is without them, of the worst clamped and the worst free edge
/// under both strips; negative where none has layers.
std::array<double, 2> worst_edges(const homogenization::UnitCell &cell, const CellModel &model,
                                  const int n_cells)
{
  constexpr int n_quads       = 4;
  const double largest_layer  = 1e-6 * std::sqrt(cell.lattice.area()); // smaller ones are rounding
  std::array<double, 2> worst = {-1., -1.};
  for (const char *name : {"strip-1", "strip-2"})
  {
    const Load load(name);
    const LayeredSheet sheet(cell, model, load, n_cells, n_quads);
    const EdgeResiduals with = sheet.left_by(*model.edges, 0.25),
                        none = sheet.left_by(without_layers(*model.edges), 0.25);
    for (std::size_t side = 0; side < none.size(); ++side)
    {
      const bool is_free         = meshes::axis_of_side(static_cast<int>(side)) != load.axis();
      const meshes::CellEdge &of = model.edges->sides[side];
      if ((is_free ? of.free : of.clamped).cwiseAbs().maxCoeff() > largest_layer)
        worst[is_free] = larger(worst[is_free], with[side].mean / none[side].mean);
    }
  }
  return worst;
}
} // namespace

std::vector<Verdict> layer_checks(const homogenization::UnitCell &cell, const CellModel &model)
{
  constexpr int few                  = 8;
  const std::array<double, 2> of_few = worst_edges(cell, model, few);
  std::array<double, 2> of_more      = of_few;
  const bool is_small                = of_few[0] < 1. && of_few[1] < 1.;
  if (!is_small)
    of_more = worst_edges(cell, model, 2 * few);
  std::vector<Verdict> checks;
  for (const bool is_free : {false, true})
    if (!(of_few[is_free] == -1.))
    {
      const double of_any = 2. * of_more[is_free] - of_few[is_free]; // by first order
      checks.push_back(judged(is_free ? "layers.free" : "layers.clamped",
                              {{"cell", cell.name}, {"cells", is_small ? few : 2 * few}},
                              of_more[is_free] < 1. ? Outcome::pass
                              : of_any < 1.         ? Outcome::inconclusive
                                                    : Outcome::fail,
                              of_more[is_free]));
    }
  return checks;
}
} // namespace homespun::verification
