// SPDX-License-Identifier: MIT
#include "verification/homogenize/homogenize_study.h"

#include "homogenization/fem/solution_pieces.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/cell/cell_files.h"
#include "verification/cell/cell_summary.h"
#include "verification/cell/study_inputs.h"
#include "verification/cell/study_of_cells.h"
#include "verification/record/on_root.h"
#include "verification/record/peak_memory.h"
#include "verification/record/progress.h"
#include "verification/record/run_folder.h"

#include <iostream>
#include <memory>

namespace homespun::verification
{
namespace
{
/// DoFs up to which the finer problem of the error bar is solved where there is no bracket.
constexpr unsigned long largest_error_bar = 4000000;

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

std::vector<OwedClaim> owed_of(const homogenization::UnitCell &cell,
                               const CellStudyOptions &options)
{
  std::vector<OwedClaim> owed = owed_of_cells({cell});
  for (OwedClaim &one : owed)
    one.of.clear(); // its checks speak of one cell, and do not name it
  BracketOptions bracket = options.bracket;
  bracket.order          = options.solve.order;
  bracket.refine         = options.solve.refine;
  if (options.bars && (bracket.tolerance || too_large_text(cell, bracket).empty()))
  {
    for (const char *id : {"bracket", "bending-bracket"})
      owed.push_back({id, {}});
    if (has_scaling_checks(cell))
    {
      owed.push_back({"constants", {}});
      owed.push_back(
        {"scaling", {{"stiffness", "C^H"}}, {"bracket.exists", "bracket.no-tolerance"}});
      owed.push_back({"scaling",
                      {{"stiffness", "D^H"}},
                      {"bracket.exists", "bracket.no-tolerance", "bending-bracket.exists",
                       "bending-bracket.no-tolerance"}});
    }
  }
  return owed;
}
} // namespace

AssessedCell run_cell_study(const homogenization::UnitCell &cell, const CellStudyOptions &options,
                            const MPI_Comm communicator)
{
  homogenization::HomogenizationOptions solve = options.solve;
  if (too_dear_second_order(cell, solve).empty())
    solve.second_order = meshes::laws_with(&meshes::LawProperties::has_second_order);
  if (options.pieces)
    solve.pieces = options.output + "/" + name_of_pieces;
  std::unique_ptr<RunFolder> folder; // on the first rank
  on_root(communicator,
          [&]()
          {
            folder = open_run_folder(options.output, {"homogenize", inputs_of(cell, options)},
                                     options.earlier, options.quiet);
            homogenization::remove_pieces(options.output + "/" + name_of_pieces);
          });
  const std::vector<OwedClaim> owed = owed_of(cell, options);
  AssessedCell assessed             = [&]()
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
              if (has_scaling_checks(cell))
                its.checks.push_back(constants_check(cell));
              for (const Verdict &check : scaling_checks(cell, its))
                its.checks.push_back(check);
            });
    return its;
  }();
  on_root(communicator,
          [&]()
          {
            for (const Verdict &missing : missing_claims(owed, assessed.checks))
              assessed.checks.push_back(missing);
          });
  share_failure(assessed.checks, communicator);
  assessed.peak_memory_of_rank = peak_memory_of_ranks(communicator);
  on_root(communicator,
          [&]()
          {
            write_cell_results(cell, assessed, options.uncertain, n_ranks_of(communicator),
                               options.output);
            folder->finish();
          });
  return assessed;
}

int homogenize_cell(const HomogenizeOptions &options, const MPI_Comm communicator)
{
  const homogenization::UnitCell cell = homogenization::read_unit_cell(
    options.file, communicator, is_root(communicator) ? &std::cerr : nullptr);
  CellStudyOptions study = options.study;
  study.uncertain        = uncertain_inputs(cell, options.uncertain);
  if (study.output.empty())
    study.output = default_folder("homogenize", {cell.name});
  const AssessedCell assessed = run_cell_study(cell, study, communicator);
  if (is_root(communicator) && !study.quiet)
    std::cout << summary(cell, assessed, study.uncertain) << "Written to " << study.output
              << ": homogenize.json, cell.h5, cell.json, characteristic-displacements.vtu"
              << (assessed.bending && assessed.bending->bracket
                    ? ", shell-section-abaqus.inp, shell-section-code_aster.comm"
                    : "")
              << (study.pieces ? ", characteristic-displacements-refined.pvtu\n" : "\n");
  return status_of(assessed.checks);
}
} // namespace homespun::verification
