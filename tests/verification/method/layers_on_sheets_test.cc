// SPDX-License-Identifier: MIT
// The layers at the edges of a sheet by what they are for: on a clamped edge the up-sampled sheet
// is where it is held, vertex by vertex, and on a free edge nothing pulls at its vertices. Both
// hold to first order in the cell: what layers leave, over what there is without them, is of
// order 1 in cell side over sheet side. A layer that belongs to another edge leaves as much as
// none.
#include "homogenization/edges/edge_layers.h"
#include "homogenization/lint/cell_reading.h"
#include "shell/membrane/membrane.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/method/coarse_model.h"
#include "verification/record/convergence.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using meshes::CellEdges;

namespace
{
constexpr double strain = 1e-3; // any: the law is linear

/// Of the vertices of a clamped edge the distance from where they are held [m], of those of a free
/// one the force that pulls at them [N].
struct Wrong
{
  double mean = 0., largest = 0.;
};
using OfEdges = std::array<Wrong, CellEdges::n_sides>;

struct LayeredSheet
{
  /// @param n_quads of the coarse mesh along a cell
  LayeredSheet(const homogenization::UnitCell &cell, const Load &load, const int n_cells,
               const int n_quads)
      : cell(cell)
      , load(load)
      , homogenized(tests::homogenized(cell))
      , edges(homogenization::edges_of(cell, {}))
      , sheet(meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells))
      , model({homogenized, &edges}, sheet, load, Method("full"), Law::linear,
              quads_per_cell(sheet, n_quads))
      , coarse(model.on_grid(model.solve(strain)))
      , membrane(shell::membrane(sheet.mesh, cell.stiffness_of_phase()))
  {
  }

  /// The up-sampled displacement with the layers of given edges.
  meshes::Points displacement(const CellEdges &with) const
  {
    localization::UpsamplerOptions options = model.parts.options;
    options.edges                          = &with;
    meshes::Points fine;
    localization::Upsampler<2, double>(homogenized, model.parts.space.grid.mesh, sheet, options)
      .upsample(coarse, fine);
    return fine - sheet.mesh.vertices;
  }

  /// @param apart from both ends of an edge, as a part of it: vertices that are nearer are left out
  OfEdges wrong(const CellEdges &with, const double apart) const
  {
    const meshes::Points u           = displacement(with);
    const shell::Positions<2> forces = shell::linear_membrane_gradient(membrane, u);
    OfEdges sums                     = {};
    std::array<int, sums.size()> n   = {};
    for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    {
      const Eigen::RowVector2d at = sheet.fraction(sheet.mesh.vertices.row(v));
      for (std::size_t side = 0; side < sums.size(); ++side)
      {
        const int axis     = meshes::axis_of_side(static_cast<int>(side));
        const double along = at(1 - axis);
        if (std::abs(at(axis) - (meshes::is_far_side(static_cast<int>(side)) ? 1. : 0.)) > 1e-9 ||
            std::min(along, 1. - along) < apart - 1e-9)
          continue;
        const double size = axis == load.axis()
                              ? (u.row(v) - load.displacement(at, sheet.sides(), strain)).norm()
                              : forces.row(v).norm();
        sums[side].mean += size;
        sums[side].largest = std::max(sums[side].largest, size);
        ++n[side];
      }
    }
    for (std::size_t side = 0; side < sums.size(); ++side)
      sums[side].mean /= n[side];
    return sums;
  }

  const homogenization::UnitCell &cell;
  const Load load;
  const meshes::HomogenizedCell homogenized;
  const CellEdges edges;
  const meshes::Sheet sheet;
  const CoarseModel model;
  const meshes::Points coarse;
  const shell::Membrane membrane;
};

CellEdges without_layers(CellEdges edges)
{
  for (meshes::CellEdge &edge : edges.sides)
  {
    edge.clamped.setZero();
    edge.free.setZero();
  }
  return edges;
}

/// Layers of the opposite edge; slip and tension stay.
CellEdges exchanged(const CellEdges &edges)
{
  CellEdges result = edges;
  for (std::size_t side = 0; side < edges.sides.size(); ++side)
  {
    const meshes::CellEdge &opposite = edges.sides[side ^ 1];
    result.sides[side].n_cells       = opposite.n_cells;
    result.sides[side].clamped       = opposite.clamped;
    result.sides[side].free          = opposite.free;
  }
  return result;
}

/// Three phases without any symmetry, on a lattice that is neither square nor rectangular. The hard
/// ones bear most of a row of cells: of smaller ones first order is small beside second.
homogenization::UnitCell lopsided()
{
  std::vector<homogenization::Phase> phases = tests::soft_and_hard();
  phases.push_back(homogenization::isotropic("between", 4., 0.1, 1., 1.));
  return tests::cell_of(tests::skewed_lattice(), 6, 6, phases,
                        [](const double f1, const double f2) {
                          return f2 < 0.34 && f1 < 0.84 ? 1 : f1 > 0.5 && f2 > 0.67 ? 2 : 0;
                        });
}
} // namespace

// In the middle half of an edge, which is of whole cells and far from corners. Both strips, so that
// each edge is clamped once and free once.
TEST(order_layers_on_sheets, what_they_leave_on_their_edges_falls_with_the_cell)
{
  const homogenization::UnitCell cell = lopsided();
  for (const char *name : {"strip-1", "strip-2"})
  {
    std::vector<double> sizes;
    std::array<std::vector<double>, CellEdges::n_sides> left, left_by_others;
    for (const int n : {4, 8, 16, 32})
    {
      const LayeredSheet sheet(cell, Load(name), n, 6);
      const OfEdges with   = sheet.wrong(sheet.edges, 0.25),
                    none   = sheet.wrong(without_layers(sheet.edges), 0.25),
                    others = sheet.wrong(exchanged(sheet.edges), 0.25);
      sizes.push_back(1. / n);
      for (std::size_t side = 0; side < none.size(); ++side)
      {
        left[side].push_back(with[side].mean / none[side].mean);
        left_by_others[side].push_back(others[side].mean / none[side].mean);
      }
    }
    for (std::size_t side = 0; side < left.size(); ++side)
    {
      const OrderJudgement judged = judge_errors(sizes, left[side], about(1.)),
                           wrong  = judge_errors(sizes, left_by_others[side], about(1.));
      EXPECT_EQ(judged.outcome, Outcome::pass) << name << " " << side << ": " << judged.why;
      EXPECT_EQ(wrong.outcome, Outcome::fail) << name << " " << side << ": " << wrong.why;
      std::printf("%s, edge %zu: left", name, side);
      for (std::size_t k = 0; k < sizes.size(); ++k)
        std::printf(" %.4f (order %.2f; by the opposite one's %.3f)", left[side][k],
                    judged.observed[k], left_by_others[side][k]);
      std::printf("\n");
    }
  }
}

// At a corner the layers of two edges add up, and neither knows of the other: there the clamped
// edge is farther off than without layers. From the second cell on it is closer, by the part that
// the order above allows.
TEST(bound_layers_on_sheets, a_clamped_edge_is_farther_off_than_without_them_at_its_ends_alone)
{
  const homogenization::UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + "checkerboard.prm");
  for (const int n : {4, 8})
  {
    const LayeredSheet sheet(cell, Load("strip-1"), n, 8);
    const CellEdges no_layers = without_layers(sheet.edges);
    for (const std::size_t side : {0, 1})
    {
      const auto largest = [&](const CellEdges &with, const double apart)
      { return sheet.wrong(with, apart)[side].largest; };
      EXPECT_GT(largest(sheet.edges, 0.), largest(no_layers, 0.));
      EXPECT_LT(largest(sheet.edges, 1. / n), largest(no_layers, 1. / n) / n);
      std::printf("%d cells, edge %zu: farthest %.2e m, without %.2e; beyond the corners %.2e, "
                  "without %.2e\n",
                  n, side, largest(sheet.edges, 0.), largest(no_layers, 0.),
                  largest(sheet.edges, 1. / n), largest(no_layers, 1. / n));
    }
  }
}
