// SPDX-License-Identifier: MIT
#include "verification/budget/budget_study.h"

#include "homogenization/fem/homogenize.h"
#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
BudgetStudy::BudgetStudy(const std::vector<std::string> &references, Table<BudgetRow> *const table,
                         const MPI_Comm communicator)
    : law_of_budget(std::find(references.begin(), references.end(), "biot") != references.end()
                      ? Law::biot
                      : law_of(references.front()))
    , table(table)
    , communicator(communicator)
{
}

bool BudgetStudy::row_is_missing(const std::string &cell_name, const std::string &load,
                                 const Law law, const double strain) const
{
  return table != nullptr && law == law_of_budget &&
         !table->contains({cell_name, load, strain, name_of(law), "total", "all"});
}

bool BudgetStudy::is_missing(const std::string &cell_name, const std::string &load, const Law law,
                             const double strain) const
{
  int answer = row_is_missing(cell_name, load, law, strain);
  MPI_Bcast(&answer, 1, MPI_INT, 0, communicator);
  return answer == 1;
}

bool BudgetStudy::is_missing(const std::string &cell_name, const std::string &load,
                             const std::vector<double> &strains) const
{
  int answer = std::any_of(strains.begin(), strains.end(),
                           [&](const double strain)
                           { return row_is_missing(cell_name, load, law_of_budget, strain); });
  MPI_Bcast(&answer, 1, MPI_INT, 0, communicator);
  return answer == 1;
}

void BudgetStudy::begin_cell(const homogenization::UnitCell &new_cell,
                             const meshes::HomogenizedCell &given)
{
  cells.given              = given;
  cells.stiffness_of_phase = new_cell.stiffness_of_phase();
  const auto homogenized   = [&](const unsigned int order, const double tolerance)
  {
    homogenization::HomogenizationOptions options;
    options.order     = order;
    options.tolerance = tolerance;
    return homogenization::homogenized_cell(
      new_cell, homogenization::homogenize(new_cell, options, communicator), given.provenance);
  };
  cells.best  = homogenized(2, homogenization::HomogenizationOptions().tolerance);
  cells.tight = homogenized(1, 1e-13);
  of_load.reset();
  load_name.clear();
  cell = &new_cell;
}

void BudgetStudy::begin_load(const homogenization::UnitCell &new_cell,
                             const meshes::HomogenizedCell &given, const meshes::Sheet &sheet,
                             const Load &load, FineReference &reference)
{
  if (cell != &new_cell)
    begin_cell(new_cell, given);
  constexpr double strain  = 0.01; // any: the law is linear
  const auto linear_answer = [&](FineReference &of)
  {
    of.start(load, Law::linear);
    const ReferenceStep step = of.advance(strain);
    if (!step.reached)
      throw meshes::NotConverged("error budget: the linear reference: " + step.why, {});
    return step.positions;
  };
  ReferenceOptions p2;
  p2.order = 2;
  FineReference best(sheet, cells.stiffness_of_phase, p2, communicator);
  const meshes::Points linear_best = linear_answer(best), linear = linear_answer(reference);
  on_root(communicator,
          [&]()
          {
            regions = regions_of(sheet, load.is_periodic());
            of_load = std::make_unique<LoadBudget>(cells, sheet, load, linear, linear_best, strain,
                                                   budget_refinement(sheet));
          });
  load_name = load.name;
}

std::string BudgetStudy::measure(const Law law, const double strain,
                                 const meshes::Points &positions, FineReference &reference,
                                 const UpsampledLevel &solved)
{
  const ReferenceStep tight = reference.tighten(1e-11);
  std::string fault;
  on_root(communicator,
          [&]()
          {
            // A solver that gets no further leaves the part of its tolerance without an answer.
            if (!tight.reached)
              fault = "the reference does not converge to 1e-11; " + tight.why;
            else
              fault = measure_on_root(law, strain, positions, tight.positions, solved);
            if (fault.empty() && !note_of_round_off(tight).empty())
              fault =
                "the part `solver` lacks what the reference's solver leaves, which is at round-off";
          });
  return fault;
}

std::string BudgetStudy::measure_on_root(const Law law, const double strain,
                                         const meshes::Points &positions,
                                         const meshes::Points &tight, const UpsampledLevel &solved)
{
  try
  {
    const ErrorBudget budget =
      of_load->measure(law, {strain, solved.coarse, solved.upsampled, positions, tight});
    for (const BudgetRow &row : budget_rows({cell->name, load_name, strain, name_of(law)}, budget,
                                            regions, std::sqrt(cell->lattice.area())))
      table->append_if_missing(row);
    return budget.misfit_of_localization <= 0.02
             ? std::string()
             : "the table of cell problems at finite strain misses checked ones by " +
                 short_text(100. * budget.misfit_of_localization) + " % of what it adds";
  }
  catch (const meshes::NotConverged &failure)
  {
    return failure.what();
  }
}
} // namespace homespun::verification
