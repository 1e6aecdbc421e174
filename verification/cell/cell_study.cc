// SPDX-License-Identifier: MIT
#include "verification/cell/cell_study.h"

#include "homogenization/fem/solution_pieces.h"
#include "verification/cell/cell_files.h"
#include "verification/cell/study_inputs.h"
#include "verification/record/on_root.h"
#include "verification/record/peak_memory.h"
#include "verification/record/progress.h"

#include <filesystem>
#include <memory>

namespace homespun::verification
{
namespace
{
/// DoFs up to which the finer problem of the error bar is solved where there is no bracket.
constexpr unsigned long largest_error_bar            = 4000000;
constexpr unsigned long largest_error_bar_of_studies = 300000;

constexpr const char *name_of_pieces = "characteristic-displacements-refined";

nlohmann::ordered_json inputs_of(const homogenization::UnitCell &cell,
                                 const CellStudyOptions &options)
{
  nlohmann::ordered_json inputs = {{"cell", cell.name},
                                   {"cell " + cell.name, fingerprint(cell)},
                                   {"order", options.solve.order},
                                   {"refine", options.solve.refine},
                                   {"bars", options.bars},
                                   {"pieces", options.pieces},
                                   {"max_dofs", options.bracket.max_dofs},
                                   {"solver", homogenization::name_of(options.solve.solver)}};
  for (const UncertainInput &input : options.uncertain)
    inputs["uncertain " + input.group + "." + homogenization::name_of(input.constant)] =
      input.range;
  if (options.bracket.tolerance)
    inputs["tolerance"] = *options.bracket.tolerance;
  return inputs;
}
} // namespace

AssessedCell run_cell_study(const homogenization::UnitCell &cell, const CellStudyOptions &options,
                            const MPI_Comm communicator)
{
  homogenization::HomogenizationOptions solve = options.solve;
  solve.checkpoint                            = options.output + "/.homespun-loads";
  solve.second_order                          = homogenization::laws_of_second_order(cell.phases);
  if (options.pieces)
    solve.pieces = options.output + "/" + name_of_pieces;
  std::unique_ptr<RunFolder> folder; // on the first rank
  on_root(communicator,
          [&]()
          {
            folder = open_run_folder(options.output, {"homogenize", inputs_of(cell, options)},
                                     options.earlier, options.quiet);
            homogenization::remove_pieces(options.output + "/" + name_of_pieces);
            std::filesystem::create_directories(solve.checkpoint);
          });
  AssessedCell assessed = [&]()
  {
    Progress progress(is_root(communicator) && !options.quiet, options.bars ? 3 : 1);
    progress.begin(cell.name + ": three cell problems");
    AssessedCell its = assess(cell, solve, communicator);
    progress.done();
    if (!options.bars)
      return its;
    progress.begin(cell.name + ": bracket on C^H");
    BracketOptions bracket = options.bracket;
    bracket.order          = options.solve.order;
    bracket.refine         = options.solve.refine;
    on_root(communicator,
            [&]()
            {
              add_bracket(
                cell, bracket,
                [&](const std::string &step)
                { bracket.tolerance ? progress.note(step) : progress.begin(step); },
                its);
            });
    add_estimate(cell, largest_error_bar, communicator, its);
    progress.done();
    progress.begin(cell.name + ": bracket on D^H");
    on_root(communicator,
            [&]()
            {
              add_bending(
                cell, bracket,
                [&](const std::string &step)
                { bracket.tolerance ? progress.note(step) : progress.begin(step); },
                its);
            });
    return its;
  }();
  share_failure(assessed.checks, communicator);
  assessed.peak_memory_of_rank = peak_memory_of_ranks(communicator);
  on_root(communicator,
          [&]()
          {
            write_cell_results(cell, assessed, options.uncertain, n_ranks_of(communicator),
                               options.output);
            std::filesystem::remove_all(solve.checkpoint);
            folder->finish();
          });
  return assessed;
}

AssessedCell assess_for_study(const homogenization::UnitCell &cell, const MPI_Comm communicator,
                              std::vector<Verdict> &verdicts,
                              const std::vector<homogenization::MembraneLaw> &second_order)
{
  homogenization::HomogenizationOptions p1;
  p1.order              = 1;
  p1.solver             = homogenization::CellSolver::fastest;
  p1.second_order       = second_order;
  AssessedCell assessed = assess(cell, p1, communicator);
  BracketOptions bracket;
  bracket.order = p1.order;
  on_root(communicator,
          [&]()
          {
            add_bracket(
              cell, bracket, [](const std::string &) {}, assessed);
          });
  add_estimate(cell, largest_error_bar_of_studies, communicator, assessed);
  for (Verdict check : assessed.checks)
  {
    check.claim = cell.name + ": " + check.claim;
    verdicts.push_back(check);
  }
  return assessed;
}

void add_bending_for_study(const homogenization::UnitCell &cell, const MPI_Comm communicator,
                           AssessedCell &assessed, std::vector<Verdict> &verdicts)
{
  on_root(communicator,
          [&]()
          {
            const std::size_t n_before = assessed.checks.size();
            add_bending(
              cell, {}, [](const std::string &) {}, assessed);
            for (std::size_t k = n_before; k < assessed.checks.size(); ++k)
            {
              verdicts.push_back(assessed.checks[k]);
              verdicts.back().claim = cell.name + ": " + verdicts.back().claim;
            }
          });
  int is_known = assessed.bending && assessed.bending->bracket;
  MPI_Bcast(&is_known, 1, MPI_INT, 0, communicator);
  if (!is_known)
    return;
  homogenization::BendingBracket found;
  if (assessed.bending)
    found = *assessed.bending->bracket;
  found.deflection.conservativeResize(cell.mesh.n_vertices(), 3);
  for (Eigen::Matrix3d *const matrix : {&found.stiffness, &found.lower, &found.upper})
    MPI_Bcast(matrix->data(), 9, MPI_DOUBLE, 0, communicator);
  MPI_Bcast(found.deflection.data(), static_cast<int>(found.deflection.size()), MPI_DOUBLE, 0,
            communicator);
  if (!assessed.bending)
    assessed.bending = CellBending{found, "handed on by the first rank", false, {}};
}
} // namespace homespun::verification
