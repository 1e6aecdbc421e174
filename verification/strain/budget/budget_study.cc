// SPDX-License-Identifier: MIT
#include "verification/strain/budget/budget_study.h"

#include "homogenization/fem/homogenize.h"
#include "meshes/plain/errors.h"
#include "verification/cell/cell_edges.h"
#include "verification/cell/energy_order.h"
#include "verification/record/main_reference.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace homespun::verification
{
BudgetStudy::BudgetStudy(const std::vector<std::string> &references,
                         const std::vector<double> &strains, Table<BudgetRow> *const table,
                         Table<CrossCheckRow> *const checks, const MPI_Comm communicator)
    : law_of_budget(law_of(main_reference(references)))
    , table(table)
    , checks(checks)
    , strains(strains)
    , communicator(communicator)
{
}

bool BudgetStudy::row_is_missing(const StrainLevel &level) const
{
  return table != nullptr && level.law == law_of_budget &&
         budget_extent(level.strain, strains) != BudgetExtent::none &&
         !table->contains(
           {level.cell, level.load, level.strain, name_of(level.law), "total", "all"});
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
  second.reset();
  load_name.clear();
  cell = &new_cell;
  on_root(communicator,
          [&]()
          {
            const KnownEdges known = known_edges(*cell, 1); // P1, as the method has it
            cells.edges            = known.edges;
            why_no_edges           = known.why_not;
            CrossCheckRow row      = {cell->name, "-", 1., "linear", "p2-cell"};
            const Eigen::Matrix3d other =
              second_p2_stiffness(cells.given, cells.stiffness_of_phase);
            row.distance = energy_difference(cells.best.stiffness, other);
            checks->append_if_missing(row);
          });
}

void BudgetStudy::begin_load(const homogenization::UnitCell &new_cell,
                             const meshes::HomogenizedCell &given, SheetReferences &new_references,
                             const Load &load)
{
  if (cell != &new_cell)
    begin_cell(new_cell, given);
  references                 = &new_references;
  const meshes::Sheet &sheet = references->sheet;
  references->by(2).start(load, law_of_budget);
  constexpr double strain = 0.01; // any: the law is linear
  on_root(communicator,
          [&]()
          {
            regions = regions_of(sheet, load.is_periodic());
            second =
              std::make_unique<SecondSheet>(cells.given, cells.stiffness_of_phase, sheet, load);
            of_load = std::make_unique<LoadBudget>(cells, sheet, load, second->linear(strain),
                                                   strain, budget_refinement(sheet));
          });
  load_name   = load.name;
  is_periodic = load.is_periodic();
}

std::string BudgetStudy::measure(const Law law, const double strain,
                                 const meshes::Points &positions, const UpsampledLevel &solved)
{
  std::string fault;
  SolvedLevel level = {strain,  solved.coarse, solved.upsampled, positions,
                       nullptr, nullptr,       nullptr};
  if (budget_extent(strain, strains) == BudgetExtent::order)
  {
    on_root(communicator, [&]() { fault = measure_on_root(law, level); });
    return fault;
  }
  const ReferenceStep tight = references->by(1).tighten(1e-11),
                      of_p2 = references->by(2).advance(strain);
  on_root(communicator,
          [&]()
          {
            // A solver that gets no further leaves the part of its tolerance without an answer.
            if (!tight.reached)
              fault = "the reference does not converge to 1e-11; " + tight.why;
            else
            {
              const std::optional<meshes::Points> second_sheet =
                solve_by_second_code(law, strain, tight.positions, fault);
              level.tight_reference      = &tight.positions;
              level.p2_reference         = of_p2.reached ? &of_p2.positions : nullptr;
              level.second               = second_sheet ? &*second_sheet : nullptr;
              const std::string of_parts = measure_on_root(law, level);
              fault += (fault.empty() || of_parts.empty() ? "" : "; ") + of_parts;
            }
            if (fault.empty() && !why_no_edges.empty() && !is_periodic)
            {
              fault =
                "the terms of edges are not known, and stand in the part `rest`; " + why_no_edges;
              why_no_edges.clear(); // once per cell
            }
            if (fault.empty() && !of_p2.reached)
              fault = "the part `reference` is not known: P2 is not reached; " + of_p2.why;
            if (fault.empty() && !note_of_round_off(tight).empty())
              fault =
                "the part `solver` lacks what the reference's solver leaves, which is at round-off";
          });
  return fault;
}

/// The sheet by the second code, and its distance from the reference into the table; nothing where
/// it has not that law, or does not converge.
std::optional<meshes::Points> BudgetStudy::solve_by_second_code(const Law law, const double strain,
                                                                const meshes::Points &tight,
                                                                std::string &fault)
{
  if (!second_code_has(law))
    return std::nullopt;
  CrossCheckRow row = {cell->name, load_name, strain, name_of(law), "sheet"};
  std::optional<meshes::Points> positions;
  try
  {
    positions = law == Law::linear ? second->linear(strain) : second->nonlinear(law, strain);
    row.distance =
      (tight - *positions).rowwise().norm().mean() / (strain * std::sqrt(cell->lattice.area()));
  }
  catch (const meshes::NotConverged &failure)
  {
    row.fault = failure.what();
    fault     = std::string("the second code: ") + failure.what();
  }
  checks->append_if_missing(row);
  return positions;
}

std::string BudgetStudy::measure_on_root(const Law law, const SolvedLevel &level)
{
  try
  {
    const ErrorBudget budget = of_load->measure(law, level);
    for (const BudgetRow &row : budget_rows({cell->name, load_name, level.strain, name_of(law)},
                                            budget, regions, std::sqrt(cell->lattice.area())))
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
