// SPDX-License-Identifier: MIT
// homespun stress: the cell, the cloth and the up-sampling under what should break them.
#include "verification/stress/stress_command.h"

#include "verification/command/study_arguments.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>

namespace homespun::verification
{
void StressCommand::add(CommandLine &line)
{
  using Arguments   = StudyArguments<StressStudyOptions>;
  CLI::App *command = line.app.add_subcommand(
    "stress", "Stiff and extreme cells and cloths: each case must end in a finite answer within "
              "its limit");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("CELL.prm", arguments->study.cell_files,
                      "Cells whose axes are climbed (default: made ones)");
  command->add_flag(
    "--quick", arguments->study.is_quick,
    "Cells of at most 1e4 triangles; beyond what is published or promised, values of at most 2 s");
  add_study<StressCommand>(
    line, *command, arguments,
    {"out/CELLS/stress, --quick stress-quick",
     "One row per axis in limits.csv: contrast, anisotropy, Poisson's ratio, thickness, slivers, "
     "size,\nposition and units of a cell, its up-sampling; time step times stiffness, thickness "
     "and "
     "density\nratio and turn per step of a cloth, time step of the scenes hang and pull. Each "
     "axis "
     "is climbed by\nfactors of 2 to 1000 until an answer is wrong or refused: the largest value "
     "that "
     "is right, where and\nwhy it ends, the criterion, and theory beside it. Every value is a row "
     "of "
     "stress.csv. Exit status 1\nwhere an axis ends before its published limit, or before theory "
     "allows.\n"
     "Example:\n  homespun stress --quick\n  homespun stress mycell.prm"},
    [](Arguments &given)
    {
      if (given.study.is_quick)
        make_quick(given.study);
    });
}
} // namespace homespun::verification
