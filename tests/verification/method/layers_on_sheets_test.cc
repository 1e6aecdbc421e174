// SPDX-License-Identifier: MIT
// What the layers at the edges of a sheet leave is of first order in the cell; a layer that belongs
// to another edge leaves as much as none.
#include "homogenization/edges/edge_layers.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/record/convergence.h"
#include "verification/strain/claims/coarse_checks.h"
#include "verification/strain/claims/layer_checks.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using meshes::CellEdges;

namespace
{
/// A cell, its edges, and a sheet of it.
struct SheetOfCell
{
  SheetOfCell(const homogenization::UnitCell &cell, const char *load, const int n_cells,
              const int n_quads)
      : homogenized(tests::homogenized(cell))
      , edges(homogenization::edges_of(cell, {}))
      , sheet(cell, {homogenized, &edges}, Load(load), n_cells, n_quads)
  {
  }
  const meshes::HomogenizedCell homogenized;
  const CellEdges edges;
  const LayeredSheet sheet;
};

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
      const SheetOfCell of(cell, name, n, 6);
      const EdgeResiduals with   = of.sheet.left_by(of.edges, 0.25),
                          none   = of.sheet.left_by(without_layers(of.edges), 0.25),
                          others = of.sheet.left_by(exchanged(of.edges), 0.25);
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
    const SheetOfCell of(cell, "strip-1", n, 8);
    const CellEdges no_layers = without_layers(of.edges);
    for (const std::size_t side : {0, 1})
    {
      const auto largest = [&](const CellEdges &with, const double apart)
      { return of.sheet.left_by(with, apart)[side].largest; };
      EXPECT_GT(largest(of.edges, 0.), largest(no_layers, 0.));
      EXPECT_LT(largest(of.edges, 1. / n), largest(no_layers, 1. / n) / n);
      std::printf("%d cells, edge %zu: farthest %.2e m, without %.2e; beyond the corners %.2e, "
                  "without %.2e\n",
                  n, side, largest(of.edges, 0.), largest(no_layers, 0.), largest(of.edges, 1. / n),
                  largest(no_layers, 1. / n));
    }
  }
}

TEST(tripwire_layer_checks, layers_of_another_sign_or_edge_fail)
{
  const homogenization::UnitCell cell       = lopsided();
  const meshes::HomogenizedCell homogenized = tests::homogenized(cell);
  const CellEdges edges                     = homogenization::edges_of(cell, {});
  const auto outcomes                       = [&](const CellEdges &with)
  {
    std::vector<Outcome> found;
    for (const Verdict &one : layer_checks(cell, {homogenized, &with}))
      found.push_back(one.outcome);
    return found;
  };
  using Outcomes = std::vector<Outcome>;
  EXPECT_EQ(outcomes(edges), (Outcomes{Outcome::pass, Outcome::pass}));
  CellEdges against = edges;
  for (meshes::CellEdge &edge : against.sides)
    edge.free *= -1.;
  EXPECT_EQ(outcomes(against), (Outcomes{Outcome::pass, Outcome::fail}));
  EXPECT_EQ(outcomes(exchanged(edges)), (Outcomes{Outcome::fail, Outcome::fail}));
  EXPECT_EQ(outcomes(without_layers(edges)), Outcomes());
}

TEST(exact_layer_checks, edges_where_there_is_nothing_to_remove_are_not_judged)
{
  const auto ids = [](const double poisson, const double slant)
  {
    meshes::Lattice lattice;
    lattice.vectors << 1., 0., slant, 0.9;
    const homogenization::UnitCell cell =
      tests::cell_of(lattice, 8, 8,
                     {homogenization::isotropic("soft", 1., poisson, 1., 1.),
                      homogenization::isotropic("hard", 10., poisson, 1., 1.)},
                     tests::halves);
    const meshes::HomogenizedCell homogenized = tests::homogenized(cell);
    const CellEdges edges                     = homogenization::edges_of(cell, {});
    std::vector<std::string> found;
    for (const Verdict &one : layer_checks(cell, {homogenized, &edges}))
      if (one.outcome != Outcome::inconclusive)
        found.push_back(one.id + (one.outcome == Outcome::pass ? "" : " fails"));
    return found;
  };
  using Ids = std::vector<std::string>;
  EXPECT_EQ(ids(0.3, 0.), (Ids{"layers.clamped", "layers.free"}));
  EXPECT_EQ(ids(0.3, 0.5), Ids{"layers.clamped"});
  EXPECT_EQ(ids(0., 0.), Ids());
}

TEST(exact_coarse_checks, coarse_cloths_of_a_cell_without_symmetry_pass_with_edges_and_without)
{
  const homogenization::UnitCell cell       = lopsided();
  const meshes::HomogenizedCell homogenized = tests::homogenized(cell);
  const CellEdges edges                     = homogenization::edges_of(cell, {});
  EXPECT_EQ(coarse_checks(cell, {homogenized, nullptr}).size(), 3u);
  const std::vector<Verdict> checks = coarse_checks(cell, {homogenized, &edges});
  ASSERT_EQ(checks.size(), 5u);
  for (const Verdict &check : checks)
    EXPECT_EQ(check.outcome, Outcome::pass) << check.claim << ": " << check.value;
  EXPECT_LT(checks[0].value, 0.02); // order 1
  EXPECT_LT(checks[1].value, 1e-13);
}
