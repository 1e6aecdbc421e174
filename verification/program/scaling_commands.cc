// SPDX-License-Identifier: MIT
// homespun scaling: time and memory against mesh and ranks.
#include "verification/program/studies.h"
#include "verification/program/study_arguments.h"
#include "verification/record/on_root.h"
#include "verification/record/run_folder.h"
#include "verification/scaling/scaling_summary.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <iostream>
#include <memory>

namespace homespun::verification
{
namespace
{
void check_scaling_arguments(const ScalingOptions &options)
{
  ArgumentFaults faults;
  if (n_ranks_of(MPI_COMM_WORLD) > 1)
    faults.add("scaling starts its ranks itself; expected it without mpirun: use --ranks, and "
               "--launcher for another way to start them");
  const auto check_list =
    [&](const char *name, const std::vector<int> &values, const int least, const int most)
  {
    for (const int value : values)
      if (value < least || value > most)
        faults.add(std::string(name) + ": found " + std::to_string(value) + "; expected " +
                   std::to_string(least) + " to " + std::to_string(most));
    if (values.empty())
      faults.add(std::string(name) + ": found nothing; expected at least one");
  };
  check_list("--refine", options.refinements, 0, 8);
  check_list("--ranks", options.ranks, 1, 1000000);
  if (options.launcher.find("{ranks}") == std::string::npos)
    faults.add("--launcher: found `" + options.launcher +
               "`; expected {ranks} where the number of ranks stands, like `srun -n {ranks}`");
  faults.throw_if_any();
}

int prepare(CommandLine &line, ScalingOptions options)
{
  if (options.output.empty())
    options.output = default_folder("scaling", stems(options.cell_files));
  line.afterwards = [options, run = line.studies.scaling]()
  {
    const ScalingResult result = run(options);
    if (!options.quiet)
    {
      std::cout << table_of(result.runs);
      print(result.verdicts);
      for (const std::string &note : notes_of(result.runs))
        std::cout << note << "\n";
      std::cout << "Written to " << options.output
                << ": scaling.csv, scaling.json, verdicts.json\n";
    }
    return status_of(result.verdicts);
  };
  return 0;
}
} // namespace

void add_scaling_command(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "scaling",
    "Time and memory of the cell problems against mesh and number of ranks, on this machine");
  const auto options = std::make_shared<ScalingOptions>();
  options->command   = line.text;
  options->cell_files.resize(1);
  command->add_option("CELL.prm", options->cell_files.front(), "Cell file")->required();
  add_list(*command, "--refine", options->refinements,
           "Uniform refinements of the mesh, comma-separated");
  add_list(*command, "--ranks", options->ranks, "Numbers of MPI ranks, comma-separated");
  command->add_option("--order", options->order, "Order of the elements, 1 or 2")
    ->check(CLI::Range(1, 2))
    ->capture_default_str();
  command
    ->add_option("--repeats", options->repeats, "Runs of each mesh and number; the median is shown")
    ->check(CLI::Range(1, 100))
    ->capture_default_str();
  command->add_option("--launcher", options->launcher, "What starts a program on {ranks} ranks")
    ->capture_default_str();
  command
    ->add_option(
      "--cores", options->cores,
      "Cores that ranks can have to themselves (default: of this machine); with more ranks times "
      "are not modelled")
    ->check(CLI::Range(1, 100000000));
  add_folder_options(*command, *options, "out/NAME/scaling");
  command->footer("Rows of one mesh are strong scaling; four times the ranks on a mesh refined "
                  "once more is weak scaling. More ranks than\n"
                  "cores share them, and their times say nothing. verification/SCALING.md tells "
                  "what the figures mean.\n"
                  "Example:\n  homespun scaling meshes/cells/three-stiffness.prm\n"
                  "  homespun scaling mycell.prm --refine 4,5,6 --ranks 16,64,256 --launcher "
                  "\"srun -n {ranks}\"");
  command->callback(
    [&line, options]()
    {
      line.check       = [options]() { check_scaling_arguments(*options); };
      line.without_mpi = [&line, options]() { return prepare(line, *options); };
    });
}
} // namespace homespun::verification
