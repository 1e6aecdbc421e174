// SPDX-License-Identifier: MIT
// homespun benchmark: what the machine at hand makes of the work, in a minute.
#include "verification/program/data_folder.h"
#include "verification/program/studies.h"
#include "verification/program/study_arguments.h"
#include "verification/record/on_root.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <iostream>
#include <memory>

namespace homespun::verification
{
namespace
{
int run_benchmark_command(BenchmarkOptions options, CommandLine &line)
{
  options.cell_file  = cells_folder() + "/layered.prm";
  options.scene_file = cells_folder() + "/../scenes/pull.prm";
  if (options.output.empty())
    options.output = "out/benchmark";
  const std::vector<BenchmarkRow> rows = line.studies.benchmark(options, MPI_COMM_WORLD);
  if (is_root(MPI_COMM_WORLD) && !options.quiet)
    std::cout << table_of(rows) << "Written to " << options.output
              << ": benchmark.csv, benchmark.json\n";
  return exit_status::good;
}
} // namespace

void add_benchmark_command(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "benchmark",
    "What this machine makes of homogenization, coarse steps and up-sampling, in a minute");
  const auto options = std::make_shared<BenchmarkOptions>();
  options->command   = line.text;
  command
    ->add_option("--refine", options->refine,
                 "Uniform refinements of the cell for its problems; 4 makes some 180,000 triangles")
    ->check(CLI::Range(0, 8))
    ->capture_default_str();
  command->add_option("--runs", options->runs, "Runs of each part; the median is compared")
    ->check(CLI::Range(1, 1000))
    ->capture_default_str();
  command->add_option("--output", options->output,
                      "Folder of the results, written anew (default out/benchmark)");
  command->add_flag("--quiet", options->quiet, "Print nothing but faults");
  command->footer(
    "The cell is `layered`, the scene `pull`: 800 coarse and 288,000 fine triangles, each of its\n"
    "steps up-sampled. Medians, means and the time that 95 of 100 do not exceed; `of limit` is "
    "the\n"
    "work of a second beside that of the row it names, measured in the same run on one thread:\n"
    "copy and triad (a = b + s c) of memory, dgemm, the product of matrices by the BLAS. Cell\n"
    "problems are solved by all ranks. Times are told and never judged: they are those of a\n"
    "machine and of all that runs on it.\n"
    "Example:\n  homespun benchmark\n  mpirun -n 2 homespun benchmark --refine 5");
  command->callback(
    [&line, options]()
    { line.solve = [&line, options]() { return run_benchmark_command(*options, line); }; });
}
} // namespace homespun::verification
