// SPDX-License-Identifier: MIT
// What the budget solves beside a study: its P2 cell is one, as the second code finds it.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/strain/budget/budget_study.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace homespun;
using namespace homespun::verification;

TEST(exact_budget_study, the_better_cell_is_p2_as_a_second_solver_finds_it)
{
  // With corners, so that P1 and P2 differ.
  const homogenization::UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + "chevron.prm");
  homogenization::HomogenizationOptions p1;
  p1.order                            = 1;
  const meshes::HomogenizedCell given = homogenization::homogenized_cell(
    cell, homogenization::homogenize(cell, p1, MPI_COMM_WORLD), "");
  SheetReferences references(meshes::tile(cell.mesh, cell.lattice, 1, 1), cell.stiffness_of_phase(),
                             MPI_COMM_WORLD);
  const std::filesystem::path folder =
    std::filesystem::temp_directory_path() / ("budget-study-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  {
    Table<BudgetRow> rows(folder);
    Table<CrossCheckRow> second(folder);
    BudgetStudy budget({"linear"}, {0.01}, &rows, &second, MPI_COMM_WORLD);
    budget.begin_load(cell, given, references, Load("periodic-11"));
    ASSERT_EQ(second.rows().size(), 1u);
    EXPECT_EQ(second.rows()[0].what, "p2-cell");
    EXPECT_LT(second.rows()[0].distance, 1e-9);
  }
  std::filesystem::remove_all(folder);
}
