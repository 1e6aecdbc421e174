// SPDX-License-Identifier: MIT
#include "verification/strain/claims/layer_checks.h"

#include "meshes/plain/sheet.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/record/claim.h"
#include "verification/strain/budget/edge_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
      if (std::abs(at(axis) - (meshes::is_far_side(static_cast<int>(side)) ? 1. : 0.)) >
            2. * meshes::image_tolerance / sheet.n1 ||
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
/// The worst of the clamped, or of the free edges of a cell under both strips.
struct WorstEdge
{
  Outcome outcome = Outcome::pass;
  double left     = std::numeric_limits<double>::quiet_NaN(); ///< over that without layers
  int n_cells     = 0;

  /// Layers leave less than there is without them, on the sheet of 8 x 8 or 16 x 16 cells. They
  /// fail where both are of order 0 in the cell.
  /// @param is_separated whether a cell is short beside what the homogenized strain varies over
  void add(const std::array<EdgeResidual, 2> &with, const std::array<EdgeResidual, 2> &without,
           const bool is_separated)
  {
    const auto is_of_order_0 = [](const std::array<EdgeResidual, 2> &all)
    { return !(all[1].mean <= 0.75 * all[0].mean); }; // first order halves
    const bool is_enough = with[0].mean < without[0].mean;
    const double here    = with[!is_enough].mean / without[!is_enough].mean;
    if (!is_enough && !is_of_order_0(without) && !is_of_order_0(with))
      return; // there is nothing to be removed
    const Outcome found = here < 1.                             ? Outcome::pass
                          : is_of_order_0(with) && is_separated ? Outcome::fail
                                                                : Outcome::inconclusive;
    if (n_cells == 0 || (!std::isnan(left) && !(here <= left)))
    {
      left    = here;
      n_cells = is_enough ? 8 : 16;
    }
    if (found != Outcome::pass && outcome != Outcome::fail)
      outcome = found;
  }
};
} // namespace

std::vector<Verdict> layer_checks(const homogenization::UnitCell &cell, const CellModel &model)
{
  constexpr int n_quads = 4;
  const double side = std::sqrt(cell.lattice.area()), stiffness = model.cell.stiffness.norm();
  constexpr double rounding = 1e-6; // of these, less is
  // Strains that a corner disturbs vary over the side of the sheet over sqrt(E / G).
  const bool is_separated = std::sqrt(contrast_of({model.cell.stiffness})) < 16.; // cells
  const CellEdges bare    = without_layers(*model.edges);
  std::array<WorstEdge, 2> worst; // clamped, free
  for (const char *name : {"strip-1", "strip-2"})
  {
    const Load load(name);
    std::array<EdgeResiduals, 2> with, without; // on 8 x 8 and 16 x 16 cells
    const auto measure = [&](const std::size_t size, const int n_cells)
    {
      const LayeredSheet sheet(cell, model, load, n_cells, n_quads);
      with[size]    = sheet.left_by(*model.edges, 0.25);
      without[size] = sheet.left_by(bare, 0.25);
    };
    measure(0, 8);
    bool has_more = false;
    for (std::size_t k = 0; k < bare.sides.size(); ++k)
    {
      const bool is_free         = meshes::axis_of_side(static_cast<int>(k)) != load.axis();
      const meshes::CellEdge &of = model.edges->sides[k];
      if ((is_free ? of.free : of.clamped).cwiseAbs().maxCoeff() <= rounding * side ||
          without[0][k].mean <= rounding * strain * side * (is_free ? stiffness : 1.))
        continue;
      if (!has_more && !(with[0][k].mean < without[0][k].mean))
      {
        measure(1, 16);
        has_more = true;
      }
      worst[is_free].add({with[0][k], with[1][k]}, {without[0][k], without[1][k]}, is_separated);
    }
  }
  std::vector<Verdict> checks;
  for (const bool is_free : {false, true})
    if (const WorstEdge &its = worst[is_free]; its.n_cells > 0)
      checks.push_back(judged(is_free ? "layers.free" : "layers.clamped",
                              {{"cell", cell.name}, {"cells", its.n_cells}}, its.outcome,
                              its.left));
  return checks;
}
} // namespace homespun::verification
