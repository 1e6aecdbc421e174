// SPDX-License-Identifier: MIT
// The claims on the energy of a reference, from rows: what is planted must be found, and what is
// right must pass.
#include "homogenization/lint/cell_reading.h"
#include "verification/strain/budget/energy_sides.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun::verification;

namespace
{
CrossCheckRow sound_row()
{
  CrossCheckRow row  = {"cell", "strip-1", 0.01, "linear", "energies"};
  row.cells          = 4;
  row.upper          = 1.;
  row.lower          = 0.98;
  row.round_off      = 1e-10;
  row.p2             = 0.99;
  row.misfit         = 1e-12;
  row.largest_misfit = 1e-9;
  return row;
}

/// PASS, FAIL or INCONCLUSIVE of: above the stress; P2 between; Clapeyron.
std::vector<Outcome> outcomes(const CrossCheckRow &row)
{
  std::vector<Outcome> all;
  for (const Verdict &verdict : energy_verdicts({row}))
    all.push_back(verdict.outcome);
  return all;
}

constexpr Outcome pass = Outcome::pass, fail = Outcome::fail, open = Outcome::inconclusive;
} // namespace

TEST(tripwire_energy_sides, each_claim_fails_where_its_theorem_is_broken)
{
  CrossCheckRow row = sound_row();
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{pass, pass, pass}));
  row.lower = 1.001;
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{fail, fail, pass}));
  row       = sound_row();
  row.lower = 0.995; // above P2 alone
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{pass, fail, pass}));
  row    = sound_row();
  row.p2 = 1.01;
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{pass, fail, pass}));
  row        = sound_row();
  row.misfit = 1e-3;
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{pass, pass, fail}));
  // To round-off both sides may agree.
  row       = sound_row();
  row.lower = row.p2 = row.upper + 0.5e-10;
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{pass, pass, pass}));
}

TEST(tripwire_energy_sides, what_was_not_solved_is_open)
{
  CrossCheckRow row = sound_row();
  row.lower = row.round_off = CrossCheckRow::none;
  row.fault                 = "stresses: no answer";
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{open, open, pass}));
  EXPECT_NE(energy_verdicts({row}).at(0).limit.find("stresses: no answer"), std::string::npos);
  row    = sound_row();
  row.p2 = CrossCheckRow::none;
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{pass, open, pass}));
  row       = sound_row();
  row.upper = row.misfit = row.largest_misfit = CrossCheckRow::none;
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{open, open, open}));
}

TEST(bound_energy_sides, a_shipped_cell_keeps_its_claims)
{
  const auto cell         = homespun::homogenization::read_unit_cell(CELLS "layered.prm");
  const CrossCheckRow row = energy_sides(cell, Load("shear-frame"), 2, MPI_COMM_SELF);
  EXPECT_EQ(outcomes(row), (std::vector<Outcome>{pass, pass, pass}));
  EXPECT_EQ(row.fault, "");
  // By Galerkin orthogonality P2 lies nearer to P1 than the solution does.
  EXPECT_LT(row.p1_to_p2, row.bar);
  EXPECT_GT(row.p1_to_p2, 0.1 * row.bar);
}
