// SPDX-License-Identifier: MIT
// The error budget on sheets whose budget theory knows: an infinite cloth errs by geometric
// nonlinearity alone, a homogeneous one by its coarse mesh alone; and a method with a planted bug
// is not explained by parts that are right.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/errors.h"
#include "verification/cell/cell_edges.h"
#include "verification/method/coarse_model.h"
#include "verification/record/convergence.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/budget/budget_rows.h"
#include "verification/strain/budget/error_budget.h"
#include "verification/strain/budget/second_code.h"
#include "verification/strain/claims/budget_verdicts.h"
#include "verification/strain/claims/strain_verdicts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::verification;
using homogenization::UnitCell;

namespace
{
BudgetCells budget_cells(const UnitCell &cell)
{
  const auto homogenized = [&](const unsigned int order, const double tolerance)
  {
    homogenization::HomogenizationOptions options;
    options.order     = order;
    options.tolerance = tolerance;
    return homogenization::homogenized_cell(
      cell, homogenization::homogenize(cell, options, MPI_COMM_WORLD), "");
  };
  return {homogenized(1, 1e-11), homogenized(2, 1e-11), homogenized(1, 1e-13),
          cell.stiffness_of_phase(), known_edges(cell, 1).edges};
}

/// The resolved sheet in linear theory at 1 %.
meshes::Points linear_reference(const UnitCell &cell, const meshes::Sheet &sheet, const Load &load,
                                const unsigned int order)
{
  ReferenceOptions options;
  options.order = order;
  FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_WORLD);
  reference.start(load, Law::linear);
  return reference.advance(0.01).positions;
}

/// The budget of a sheet of n x n cells.
/// @param used what the method up-samples with; the budget has the right cell
/// @param left by the solver of the reference, at each vertex in both directions [m]
ErrorBudget measured(const UnitCell &cell, const BudgetCells &cells, const Load &load, const int n,
                     const double strain, const meshes::HomogenizedCell &used,
                     const int refinement = 8, const Law law = Law::biot, const double left = 0.)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
  FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_WORLD);
  reference.start(load, law);
  meshes::Points fine        = reference.advance(strain).positions;
  const meshes::Points tight = reference.tighten(1e-11).positions;
  fine.array() += left;
  const CoarseModel model({used}, sheet, load, Method("localized"), law);
  const CoarseState coarse       = model.solve(strain);
  const meshes::Points upsampled = model.upsample(coarse);
  LoadBudget budget(cells, sheet, load,
                    SecondSheet(cells.given, cells.stiffness_of_phase, sheet, load).linear(0.01),
                    0.01, refinement);
  const meshes::Points second =
    law == Law::linear
      ? SecondSheet(cells.given, cells.stiffness_of_phase, sheet, load).linear(strain)
      : SecondSheet(cells.given, cells.stiffness_of_phase, sheet, load)
          .nonlinear(Law::biot, strain);
  return budget.measure(law, {strain, coarse.positions, upsampled, fine, &tight, nullptr, &second});
}

double mean(const meshes::Points &field)
{
  return field.rowwise().norm().mean();
}

UnitCell layered()
{
  return homogenization::read_unit_cell(CELLS "layered.prm");
}
} // namespace

TEST(exact_error_budget, an_infinite_cloth_errs_by_geometric_nonlinearity_alone)
{
  const UnitCell cell      = layered();
  const BudgetCells cells  = budget_cells(cell);
  const ErrorBudget budget = measured(cell, cells, Load("periodic-12"), 1, 0.1, cells.given);
  const double total       = mean(budget.total);
  EXPECT_GT(total, 1e-5 * 0.01);
  // Part 2 comes from a cell problem that shares no code with the resolved reference.
  EXPECT_LT(mean(budget.parts.at("modes") - budget.total), 1e-5 * total);
  for (const char *part : {"slip", "selvedge", "bulk", "layer", "rest", "macro-law", "coarse-mesh",
                           "cell", "blending", "time-step", "solver"})
    EXPECT_LT(mean(budget.parts.at(part)), 1e-5 * total) << part;
  EXPECT_LT(budget.misfit_of_localization, 1e-3);
}

TEST(exact_error_budget,
     what_the_solver_of_the_reference_leaves_is_a_part_with_the_sign_of_the_error)
{
  const UnitCell cell      = layered();
  const BudgetCells cells  = budget_cells(cell);
  constexpr double left    = 1e-5;
  const ErrorBudget sound  = measured(cell, cells, Load("periodic-12"), 1, 0.1, cells.given),
                    budget = measured(cell, cells, Load("periodic-12"), 1, 0.1, cells.given, 8,
                                      Law::biot, left);
  // The error is up-sampled minus reference: what is too much in the reference counts as too
  // little.
  for (const auto &change : {meshes::Points(budget.total - sound.total),
                             meshes::Points(budget.parts.at("solver") - sound.parts.at("solver"))})
    EXPECT_LT((change.array() + left).abs().maxCoeff(), 1e-9 * left);
}

TEST(order_error_budget, the_cell_at_finite_strain_leaves_the_linear_theory_with_second_order)
{
  const UnitCell cell     = layered();
  const BudgetCells cells = budget_cells(cell);
  const NonlinearCell nonlinear(cells.given, cells.stiffness_of_phase, Law::biot);
  const Eigen::Vector3d direction(0.5, 0.7, 1.);
  std::vector<double> strains, of_stress, of_fluctuation;
  for (double strain = 1e-3; strain < 0.01; strain *= 2.)
  {
    const CellState state = nonlinear.solve(strain * direction);
    meshes::Points excess = state.fluctuation;
    for (int a = 0; a < 3; ++a)
      excess += strain * direction(a) * cells.given.chi.middleCols<2>(2 * a);
    strains.push_back(strain);
    of_stress.push_back((state.stress - strain * cells.given.stiffness * direction).norm());
    of_fluctuation.push_back(excess.norm());
  }
  EXPECT_NEAR(log_slope(strains, of_stress), 2., 0.1);
  EXPECT_NEAR(log_slope(strains, of_fluctuation), 2., 0.1);
}

TEST(exact_error_budget, a_homogeneous_sheet_errs_by_its_coarse_mesh_alone)
{
  UnitCell cell = layered();
  for (homogenization::Phase &phase : cell.phases)
    phase = cell.phases[0];
  const BudgetCells cells  = budget_cells(cell);
  const ErrorBudget budget = measured(cell, cells, Load("shear-frame"), 3, 0.01, cells.given);
  const double coarse      = mean(budget.parts.at("coarse-mesh"));
  EXPECT_NEAR(coarse / mean(budget.total), 1., 0.1);
  for (const char *part :
       {"slip", "selvedge", "bulk", "layer", "macro-law", "modes", "cell", "blending", "solver"})
    EXPECT_LT(mean(budget.parts.at(part)), 1e-6 * coarse) << part;
  // The resolved sheet and the reference have meshes of their own; with eightfold refinement an
  // error of order two is down to 1/64, at the corners of the frame less.
  EXPECT_LT(mean(budget.parts.at("rest")), 0.1 * coarse);
}

TEST(order_error_budget, the_homogenized_sheet_that_counts_as_resolved_approaches_its_limit)
{
  UnitCell cell = layered();
  for (homogenization::Phase &phase : cell.phases)
    phase = cell.phases[0];
  const BudgetCells cells = budget_cells(cell);
  const auto resolution   = [&](const int refinement)
  {
    const ErrorBudget budget =
      measured(cell, cells, Load("shear-frame"), 3, 0.01, cells.given, refinement);
    return mean(budget.parts.at("resolution"));
  };
  // Order two away from the corners of the frame; |u_2 - u_1| / |u_8 - u_4| is 16 for it.
  EXPECT_GT(resolution(2) / resolution(8), 8.);
}

TEST(exact_error_budget, the_parts_of_a_sheet_leave_nothing_in_linear_theory)
{
  const UnitCell cell     = layered();
  const BudgetCells cells = budget_cells(cell);
  for (const char *load : {"strip-2", "shear-frame"})
  {
    const ErrorBudget budget =
      measured(cell, cells, Load(load), 4, 0.01, cells.given, 8, Law::linear);
    EXPECT_LT(mean(budget.sum() - budget.total), 1e-6 * mean(budget.total)) << load;
    EXPECT_LT(budget.bar, 1e-3 * mean(budget.total)) << load;
  }
}

TEST(tripwire_error_budget, a_piece_at_edges_that_is_wrong_by_half_is_not_made_up_for_by_others)
{
  const UnitCell cell     = layered();
  const BudgetCells cells = budget_cells(cell);
  for (const char *part : {"slip", "selvedge", "layer", "rest"})
  {
    ErrorBudget budget =
      measured(cell, cells, Load("shear-frame"), 4, 0.01, cells.given, 8, Law::linear);
    budget.parts[part] *= 0.5;
    EXPECT_GT(mean(budget.sum() - budget.total), 10. * budget.bar) << part;
  }
}

TEST(exact_error_budget, without_terms_of_edges_their_pieces_stand_in_the_rest)
{
  const UnitCell cell     = layered();
  const BudgetCells cells = budget_cells(cell);
  BudgetCells without     = cells;
  without.edges           = std::nullopt;
  const auto budget_of    = [&](const BudgetCells &some)
  { return measured(cell, some, Load("strip-1"), 4, 0.01, cells.given, 8, Law::linear); };
  const ErrorBudget with = budget_of(cells), none = budget_of(without);
  EXPECT_EQ(mean(none.parts.at("selvedge")), 0.);
  EXPECT_LT(mean(with.sum() - none.sum()), 1e-9 * mean(with.total));
  EXPECT_LT(mean(with.parts.at("rest")), 0.5 * mean(none.parts.at("rest")));
}

TEST(order_error_budget, what_the_parts_of_a_sheet_leave_falls_with_second_order_in_strain)
{
  const UnitCell cell     = layered();
  const BudgetCells cells = budget_cells(cell);
  std::vector<double> strains, left, bars;
  for (const double strain : {0.001, 0.002, 0.004})
  {
    const ErrorBudget budget = measured(cell, cells, Load("shear-frame"), 4, strain, cells.given);
    strains.push_back(strain);
    left.push_back(mean(budget.sum() - budget.total));
    bars.push_back(budget.bar);
    EXPECT_LT(left.back(), budget.bar);
  }
  EXPECT_NEAR(log_slope(strains, left), 2., 0.1);
  EXPECT_NEAR(log_slope(strains, bars), 2., 0.3); // beside it what the solvers leave, of order 1
}

// An infinite cloth has no other part: there the sum is not closed by another one.
TEST(tripwire_error_budget, a_part_2_that_is_wrong_by_half_is_not_made_up_for_by_other_parts)
{
  const UnitCell cell     = layered();
  const BudgetCells cells = budget_cells(cell);
  ErrorBudget budget      = measured(cell, cells, Load("periodic-12"), 1, 0.1, cells.given);
  EXPECT_LT(mean(budget.sum() - budget.total), budget.bar);
  budget.parts["modes"] *= 0.5;
  EXPECT_GT(mean(budget.sum() - budget.total), 10. * budget.bar);
}

TEST(exact_second_code, both_codes_find_one_sheet_in_linear_theory_and_at_finite_strain)
{
  for (const char *name : {"layered", "three-stiffness"})
  {
    const UnitCell cell     = homogenization::read_unit_cell(CELLS + std::string(name) + ".prm");
    const BudgetCells cells = budget_cells(cell);
    for (const char *load_name : {"periodic-12", "strip-1", "shear-frame"})
    {
      const Load load(load_name);
      const int n               = load.is_periodic() ? 1 : 3;
      const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
      const double unit         = 0.01 * std::sqrt(cell.lattice.area());
      EXPECT_LT(mean(linear_reference(cell, sheet, load, 1) -
                     SecondSheet(cells.given, cells.stiffness_of_phase, sheet, load).linear(0.01)),
                1e-7 * unit)
        << name << load_name;
      FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_WORLD);
      reference.start(load, Law::biot);
      reference.advance(0.01);
      const meshes::Points fine = reference.tighten(1e-11).positions;
      EXPECT_LT(mean(fine - SecondSheet(cells.given, cells.stiffness_of_phase, sheet, load)
                              .nonlinear(Law::biot, 0.01)),
                1e-7 * unit)
        << name << load_name;
    }
    EXPECT_LT(
      (cells.best.stiffness - second_p2_stiffness(cells.given, cells.stiffness_of_phase)).norm(),
      1e-8 * cells.best.stiffness.norm());
  }
}

TEST(exact_second_code, both_codes_find_one_sheet_of_yarns_which_is_not_the_corotational_one)
{
  UnitCell cell = layered();
  for (std::size_t p = 0; p < cell.phases.size(); ++p)
  {
    homogenization::Phase &phase = cell.phases[p];
    phase.E2                     = 0.5 * phase.E1;
    phase.G12                    = phase.E1 / 40.;
    phase.angle                  = 30. * static_cast<double>(p);
  }
  const BudgetCells cells = budget_cells(cell);
  for (const char *name : {"periodic-11", "strip-1", "shear-frame"})
  {
    const Load load(name);
    const int n                = load.is_periodic() ? 1 : 3;
    const meshes::Sheet sheet  = meshes::tile(cell.mesh, cell.lattice, n, n);
    constexpr double strain    = 0.03;
    const double unit          = strain * std::sqrt(cell.lattice.area());
    const auto distance_to_law = [&](const Law law)
    {
      FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_WORLD);
      reference.start(load, Law::yarn);
      EXPECT_TRUE(reference.advance(strain).reached);
      return mean(
        reference.tighten(1e-11).positions -
        SecondSheet(cells.given, cells.stiffness_of_phase, sheet, load).nonlinear(law, strain));
    };
    EXPECT_LT(distance_to_law(Law::yarn), 1e-7 * unit) << name;
    EXPECT_GT(distance_to_law(Law::biot), 100. * agreement * unit) << name;
  }
}

TEST(tripwire_second_code, exchanged_phases_and_a_p2_cell_that_was_never_computed_are_seen)
{
  const UnitCell cell     = homogenization::read_unit_cell(CELLS "three-stiffness.prm");
  const BudgetCells cells = budget_cells(cell);
  const Load load("shear-frame");
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 3, 3);
  UnitCell exchanged        = cell; // what the reference would read, were its phases exchanged
  std::swap(exchanged.phases[0], exchanged.phases[1]);
  EXPECT_GT(mean(linear_reference(exchanged, sheet, load, 1) -
                 SecondSheet(cells.given, cells.stiffness_of_phase, sheet, load).linear(0.01)),
            1e-3 * 0.01 * std::sqrt(cell.lattice.area()));
  EXPECT_GT(
    (cells.given.stiffness - second_p2_stiffness(cells.given, cells.stiffness_of_phase)).norm(),
    1e-5 * cells.given.stiffness.norm());
  meshes::Sheet wrong = sheet; // a sheet whose phases were lost on the way
  wrong.mesh.material.setZero();
  EXPECT_EQ(phases_of_sheet(cells.given, wrong), sheet.mesh.material);
}

TEST(tripwire_error_budget, a_method_with_a_bug_is_not_explained_by_parts_that_are_right)
{
  const UnitCell cell           = layered();
  const BudgetCells cells       = budget_cells(cell);
  meshes::HomogenizedCell wrong = cells.given;
  wrong.chi.col(3) *= -1.; // the sign of chi across the stripes
  // The method goes wrong, the budget does not know: its parts come from the right cell.
  const meshes::Points total = measured(cell, cells, Load("strip-2"), 4, 0.01, wrong).total;
  ErrorBudget budget         = measured(cell, cells, Load("strip-2"), 4, 0.01, cells.given);
  EXPECT_GT(mean(total), 2. * mean(budget.total));
  budget.total = total;
  const std::vector<int> everywhere(static_cast<std::size_t>(total.rows()), 1);
  const std::vector<Verdict> verdicts = budget_verdicts(
    {{"layered", "strip-2", 0.01, "biot", "localized"}},
    budget_rows({"layered", "strip-2", 0.01, "biot"}, budget, everywhere, 0.01), {0.01});
  EXPECT_EQ(verdicts.at(0).outcome, Outcome::fail) << verdicts.at(0).claim << verdicts.at(0).value;
}
