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
                      "Cells whose C^H and chi the cases take too (default: made ones alone)");
  command->add_flag("--quick", arguments->study.is_quick,
                    "Each case twice instead of ten times, cells of at most 1e5 triangles");
  add_study<StressCommand>(
    line, *command, arguments,
    {"out/CELLS/stress, --quick stress-quick",
     "Axes of what is hard: contrast, Poisson's ratio, anisotropy, slivers and size of a cell; "
     "time step,\n"
     "stiffness, density and turn per step of a cloth. Of your cells beside that: moved, turned,\n"
     "mirrored and in other units; up-sampled. stress.csv has a row per case: what was expected, "
     "the outcome,\n"
     "one figure, its limit and where that comes from; solver.csv iterations and times of the "
     "cell problem\n"
     "along its axes. A case that fails is a row, and exit status 1.\n"
     "Example:\n  homespun stress --quick\n  homespun stress mycell.prm"},
    [](Arguments &given)
    {
      if (given.study.is_quick)
        make_quick(given.study);
    });
}
} // namespace homespun::verification
