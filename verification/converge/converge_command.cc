// SPDX-License-Identifier: MIT
// homespun converge: observed orders of everything that is discretised.
#include "verification/converge/converge_command.h"

#include "verification/command/study_arguments.h"
#include "verification/converge/converge_cases.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>

namespace homespun::verification
{
void ConvergeCommand::add(CommandLine &line)
{
  using Arguments   = StudyArguments<ConvergenceStudyOptions>;
  CLI::App *command = line.app.add_subcommand(
    "converge",
    "Observed orders in mesh, adaptivity, cells per sheet, coarse mesh, strain and time step");
  const auto arguments           = std::make_shared<Arguments>();
  ConvergenceStudyOptions &study = arguments->study;
  for (const std::string &name : convergence_studies())
    if (name != "bending") // is asked for
      study.studies.push_back(name);
  command->add_option("CELL.prm", study.cell_files, "Cell files")->required();
  add_list(*command, "--studies", study.studies, "Studies, comma-separated");
  command->add_flag("--quick", study.is_quick, "Fewer and smaller levels: a minute");
  add_study<ConvergeCommand>(
    line, *command, arguments,
    {"out/NAME/converge, with --quick out/NAME/converge-quick",
     "Studies: mesh (uniform refinement of the cell, P1 and P2), adaptive (width of "
     "the bracket on C^H), scale\n"
     "(cells per sheet), coarse (coarse triangles per cell), edges (cells per sheet, with the "
     "terms of edges), bending\n"
     "(cells per sheet that is bent: only where it is named), strain (periodic loads "
     "under the law of the cell), time (steps of the coarse cloth).\n"
     "An order that has not settled is INCONCLUSIVE, not a failure: exit status 4.\n"
     "Example:\n  homespun converge mycell.prm --quick\n"
     "  mpirun -n 2 homespun converge mycell.prm --studies mesh,scale\n"
     "  homespun converge mycell.prm --quick --studies bending"},
    [](const Arguments &given)
    {
      ArgumentFaults faults;
      faults.check_names("--studies", given.study.studies, convergence_studies());
      if (given.study.studies.empty())
        faults.add("--studies: found nothing; expected at least one");
      faults.throw_if_any();
    });
}
} // namespace homespun::verification
