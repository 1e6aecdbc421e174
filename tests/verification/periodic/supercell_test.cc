// SPDX-License-Identifier: MIT
// Patterns over several cells: the periodic state repeated, the waves of a supercell, and the state
// of less energy that a negative margin predicts.
#include "tests/verification/periodic/bloch_cell.h"
#include "verification/periodic/margin_path.h"
#include "verification/periodic/supercell.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using homespun::tests::BlochCell;

TEST(exact_supercell, waves_of_two_by_two_cells_are_three)
{
  const BlochCell cell("chevron");
  const Supercell two(cell.cell, {2, 2});
  ASSERT_EQ(two.waves().size(), 3u);
  EXPECT_EQ(two.waves()[2].k, Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(Supercell(cell.cell, {3, 1}).waves().size(), 1u); // 1/3 and 2/3 are conjugate
  EXPECT_EQ(Supercell(cell.cell, {3, 3}).waves().size(), 4u);
}

TEST(exact_supercell, the_periodic_state_repeated_is_in_equilibrium_with_the_same_energy)
{
  const BlochCell cell("chevron");
  const CellAssembly assembly  = cell.assembly(Law::biot);
  PeriodicPath path            = tests::path_along(assembly, "uniaxial-2");
  const CellEquilibrium &state = path.at(-0.08);
  const Supercell two(cell.cell, {2, 1});
  const CellAssembly all(two.cell, cell.phases, Law::biot);
  const CellEquilibrium both = two.repeated(state);
  const auto sums            = all.sums(both.gradient, both.fluctuation, Tangent::none);
  EXPECT_NEAR(sums.energy, state.energy, 1e-12 * state.energy);
  EXPECT_LE(sums.residual.norm(), 1e-10 * sums.force_size);
}

// The pattern is the claim of the margin: below zero at k there is less energy with period 1/k.
TEST(bound_supercell, the_pattern_that_the_margin_predicts_has_less_energy)
{
  const BlochCell cell("honeycomb");
  const CellAssembly assembly = cell.assembly(Law::biot);
  const BlochMargin bloch(assembly);
  PeriodicPath path = tests::path_along(assembly, "periodic-22");
  const Supercell two(cell.cell, {1, 2});
  const CellAssembly all(two.cell, cell.phases, Law::biot);
  EXPECT_FALSE(followed_pattern(bloch, two, path.at(-0.1), {}));
  const auto beyond = followed_pattern(bloch, two, path.at(-0.16), {});
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->wave.wave.text(), "k = (0, 1/2)");
  EXPECT_LT(beyond->wave.beta, 0.);
  EXPECT_GT(beyond->lower(), 1e-3);
  const auto sums = all.sums(beyond->state.gradient, beyond->state.fluctuation, Tangent::none);
  EXPECT_LE(sums.residual.norm(), 1e-9 * sums.force_size);
  std::printf("honeycomb, periodic-22, -16 %%: %.2f %% less energy\n", 100. * beyond->lower());
}

// Its cells make no block, and so no supercell: levels that are lost to a pattern have no row of
// one.
TEST(invariant_supercell, a_cell_whose_sides_meet_holes_has_margins_but_no_patterns)
{
  BlochCell cell("honeycomb");
  for (const bool cuts_holes : {false, true})
  {
    cell.cell.lattice.cuts_holes = cuts_holes;
    const BlochMargin bloch(cell.assembly(Law::biot));
    const LoadControl control = load_control(Load("periodic-22"));
    const MarginPath path     = margin_path(bloch, control, {-0.16}, {});
    EXPECT_EQ(path.rows.at(0).outcome, "unstable-proved");
    EXPECT_EQ(patterns_of(bloch, control, path.levels, {}, {}).size(), cuts_holes ? 0u : 1u);
  }
}
