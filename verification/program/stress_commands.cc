// SPDX-License-Identifier: MIT
// homespun stress: the cell, the cloth and the up-sampling under what should break them.
#include "verification/program/studies.h"
#include "verification/program/study_arguments.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>

namespace homespun::verification
{
namespace
{
struct StressArguments
{
  StressStudyOptions study;
  StudyEnd end;
  bool quick = false;
};

int run_stress(StressArguments arguments, CommandLine &line)
{
  StressStudyOptions &study = arguments.study;
  if (arguments.quick)
  {
    study.repeats        = 2;
    study.most_triangles = 100000;
  }
  if (study.output.empty())
    study.output = default_folder("stress", stems(study.cell_files), arguments.quick);
  return arguments.end.conclude(line.studies.stress(study, MPI_COMM_WORLD), study.output,
                                study.quiet, line.afterwards);
}
} // namespace

void add_stress_command(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "stress", "What should break a cell or a cloth: each case must end in a "
              "finite answer or a named refusal");
  const auto arguments     = std::make_shared<StressArguments>();
  arguments->study.command = line.text;
  command->add_option("CELL.prm", arguments->study.cell_files,
                      "Cells whose C^H and chi the cases take (default: built-in ones)");
  command->add_flag("--quick", arguments->quick,
                    "Each case twice instead of ten times, cells of at most 1e5 triangles");
  add_folder_options(*command, arguments->study, "out/CELLS/stress, --quick stress-quick");
  arguments->end.add_options(*command);
  command->footer(
    "Cells of high contrast, slivers, moved cells, time steps, stiffness, starts, meshes, "
    "rotations,\n"
    "motions, scenes, up-sampling; stress.csv has a row per case: what was expected, the outcome, "
    "one figure,\n"
    "its limit and where that comes from. A case that fails is a row, and exit status 1.\n"
    "Example:\n  homespun stress --quick\n  homespun stress mycell.prm");
  command->callback(
    [&line, arguments]()
    { line.solve = [&line, arguments]() { return run_stress(*arguments, line); }; });
}
} // namespace homespun::verification
