// SPDX-License-Identifier: MIT
// The error budget of a strain study: what it solves beside the study, and its table.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/reference/sheet_references.h"
#include "verification/strain/budget/budget_rows.h"
#include "verification/strain/budget/error_budget.h"
#include "verification/strain/budget/second_code.h"
#include "verification/strain/strain_output.h"

#include <mpi.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The method at one strain.
struct UpsampledLevel
{
  shell::Positions<2> coarse; ///< (n_coarse,2) [m]
  meshes::Points upsampled;   ///< by `localized`, (n_fine,2), double precision [m]
};

/// Goes along with a strain study: begin_load(), then measure() at each strain of one law, `biot`
/// or the study's first. Solves with deal.II on all ranks, measures on the first.
class BudgetStudy
{
public:
  /// @param references, strains of the study
  /// @param table, checks budget.csv and cross-checks.csv on the first rank, elsewhere null
  BudgetStudy(const std::vector<std::string> &references, const std::vector<double> &strains,
              Table<BudgetRow> *table, Table<CrossCheckRow> *checks, MPI_Comm communicator);

  /// Whether a budget of a level, whole or part 2 alone, is asked for and not yet in the table, as
  /// the first rank sees it.
  bool row_is_missing(const StrainLevel &level) const;

  /// Solves the sheet in linear theory by the second code, starts the P2 reference, and at the
  /// first load of a cell homogenizes it in the further ways that the budget compares.
  /// @param cell, references to be kept by the caller while its loads last
  /// @throws NotConverged on every rank
  void begin_load(const homogenization::UnitCell &cell, const meshes::HomogenizedCell &given,
                  SheetReferences &references, const Load &load);

  /// Measures the parts at a level that the P1 reference has just reached, and writes their rows.
  /// @param positions of that level
  /// @param solved what the method made of it, on the first rank
  /// @return what was not found, empty where all was; the first rank alone knows
  std::string measure(Law law, double strain, const meshes::Points &positions,
                      const UpsampledLevel &solved);

  const Law law_of_budget;

private:
  void begin_cell(const homogenization::UnitCell &cell, const meshes::HomogenizedCell &given);
  std::string measure_on_root(Law law, const SolvedLevel &level);
  std::optional<meshes::Points>
  solve_by_second_code(Law law, double strain, const meshes::Points &tight, std::string &fault);

  Table<BudgetRow> *const table;
  Table<CrossCheckRow> *const checks;
  const std::vector<double> strains; ///< of the study
  const MPI_Comm communicator;
  const homogenization::UnitCell *cell = nullptr;
  BudgetCells cells;
  std::unique_ptr<LoadBudget> of_load;   ///< first rank
  std::unique_ptr<SecondSheet> second;   ///< first rank
  SheetReferences *references = nullptr; ///< every rank
  std::vector<int> regions;
  std::string load_name;
  bool is_periodic = false;
  std::string why_no_edges; ///< told once per cell; first rank
};
} // namespace homespun::verification
