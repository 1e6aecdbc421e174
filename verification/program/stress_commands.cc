// SPDX-License-Identifier: MIT
// homespun stress: the cell, the cloth and the up-sampling under what should break them.
#include "verification/program/studies.h"
#include "verification/program/study_arguments.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>

namespace homespun::verification
{
void add_stress_command(CommandLine &line)
{
  using Arguments   = StudyArguments<StressStudyOptions>;
  CLI::App *command = line.app.add_subcommand(
    "stress", "What should break a cell or a cloth: each case must end in a "
              "finite answer or a named refusal");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("CELL.prm", arguments->study.cell_files,
                      "Cells whose C^H and chi the cases take (default: built-in ones)");
  command->add_flag("--quick", arguments->study.is_quick,
                    "Each case twice instead of ten times, cells of at most 1e5 triangles");
  add_study(
    line, *command, arguments,
    {"out/CELLS/stress, --quick stress-quick",
     "Cells of high contrast, slivers, moved cells, time steps, stiffness, starts, "
     "spins,\n"
     "motions, scenes, up-sampling; stress.csv has a row per case: what was expected, the outcome, "
     "one figure,\n"
     "its limit and where that comes from. A case that fails is a row, and exit status 1.\n"
     "Example:\n  homespun stress --quick\n  homespun stress mycell.prm"},
    &Studies::stress,
    [](Arguments &given)
    {
      if (given.study.is_quick)
        make_quick(given.study);
    });
}
} // namespace homespun::verification
