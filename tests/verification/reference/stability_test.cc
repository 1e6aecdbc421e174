// SPDX-License-Identifier: MIT
#include "tests/homogenization/cell/cells.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/claims/strain_verdicts.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::verification;
using homogenization::UnitCell;

namespace
{
/// Isotropic, Poisson's ratio zero: what a beam is made of.
UnitCell beam_cell()
{
  return tests::cell_of(tests::square_lattice(0.01), 4, 4,
                        {{"cloth", 1e3, 1e3, 0., 5e2, 0., 1., 1.}},
                        [](double, double) { return 0; });
}

/// A column one cell wide and twelve long, clamped at both ends, shortened along its axis. By beam
/// theory it buckles at 4 pi^2 I / (A L^2) = (pi w / L)^2 / 3 = 2.28 %.
constexpr int n_long             = 12;
constexpr double buckling_strain = M_PI * M_PI / (3. * n_long * n_long);
} // namespace

TEST(exact_stability, a_column_buckles_where_theory_says_and_is_left_along_its_mode)
{
  const UnitCell cell       = beam_cell();
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, n_long);
  for (const auto &[share, expected] : {std::pair{0.8, Stability::stable}, {1.3, Stability::left}})
  {
    FineReference reference(sheet, cell.stiffness_of_phase(), {2, 0}, MPI_COMM_SELF);
    reference.start(Load("strip-2"), Law::biot);
    ReferenceStep step = reference.advance(-share * buckling_strain);
    ASSERT_TRUE(step.reached) << step.why;
    const meshes::Points straight = step.positions;
    EXPECT_EQ(reference.stabilize(step), expected) << share << ": " << name_of(expected);
    EXPECT_GT(step.n_indefinite, 0u);
    const double moved = (step.positions - straight).col(0).cwiseAbs().maxCoeff();
    if (expected == Stability::stable)
      EXPECT_EQ(moved, 0.);
    else
      EXPECT_GT(moved, 0.1 * 0.01); // a good part of a cell sideways
    // What was found stays: it is stable now.
    EXPECT_EQ(reference.stabilize(step), Stability::stable);
  }
}

TEST(exact_stability, a_sheet_in_tension_is_stable_triangle_by_triangle)
{
  const UnitCell cell       = beam_cell();
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 4, 4);
  for (const Law law : {Law::linear, Law::biot, Law::green})
  {
    FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_SELF);
    reference.start(Load("periodic-11"), law);
    ReferenceStep step = reference.advance(0.05);
    ASSERT_TRUE(step.reached);
    EXPECT_EQ(reference.stabilize(step), Stability::every_triangle);
  }
}

TEST(exact_stability, an_equilibrium_that_is_no_minimum_leaves_its_claim_open)
{
  LevelRow step;
  step.cell                   = "cell";
  step.load                   = "strip-1";
  step.reference              = "biot";
  std::vector<LevelRow> steps = {step, step, step};
  steps[0].stability          = name_of(Stability::every_triangle);
  steps[1].stability          = name_of(Stability::stable);
  steps[2].stability          = name_of(Stability::left);
  EXPECT_EQ(stability_verdicts(steps).at(0).outcome, Outcome::pass);
  for (const Stability open : {Stability::unstable, Stability::unknown})
  {
    steps[2].stability = name_of(open);
    EXPECT_EQ(stability_verdicts(steps).at(0).outcome, Outcome::inconclusive);
    EXPECT_EQ(stability_verdicts(steps).at(0).value, 1.);
  }
  for (LevelRow &one : steps)
    one.reference = "linear";
  EXPECT_TRUE(stability_verdicts(steps).empty());
}
