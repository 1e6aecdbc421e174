// SPDX-License-Identifier: MIT
// homespun strain, report: studies and their pages.
#include "meshes/errors.h"
#include "verification/build_info.h"
#include "verification/commands.h"
#include "verification/lightweight_cloth.h"
#include "verification/strain_study.h"

#include <deal.II/base/mpi.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>

#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace homespun::verification
{
namespace
{
struct StrainArguments
{
  StrainStudyOptions study;
  bool quick = false, no_report = false;
};

/// Ascending strains; the references walk up the ladder.
void check_arguments(StrainStudyOptions &study)
{
  std::vector<std::string> faults;
  for (const double strain : study.strains)
    if (!(strain > 0. && strain <= 1.))
      faults.push_back("--strains: found " + std::to_string(strain) +
                       "; expected fractions between 0 and 1, 0.1 is 10 %");
  std::sort(study.strains.begin(), study.strains.end());
  study.strains.erase(std::unique(study.strains.begin(), study.strains.end()), study.strains.end());
  const auto collect =
    [&](const char *option, const std::vector<std::string> &names, const auto &make)
  {
    if (names.empty())
      faults.push_back(std::string(option) + ": found nothing; expected at least one");
    for (const std::string &name : names)
      try
      {
        make(name);
      }
      catch (const meshes::BadInput &bad)
      {
        faults.push_back(std::string(option) + ": " + bad.what());
      }
  };
  collect("--loads", study.loads, [](const std::string &name) { static_cast<void>(Load(name)); });
  collect("--references", study.references,
          [](const std::string &name) { static_cast<void>(law_of(name)); });
  collect("--methods", study.methods,
          [](const std::string &name) { static_cast<void>(Method(name)); });
  if (study.strains.empty())
    faults.push_back("--strains: found nothing; expected at least one fraction");
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

int run_strain(StrainArguments arguments, Afterwards &afterwards)
{
  StrainStudyOptions &study = arguments.study;
  check_arguments(study);
  if (study.output.empty())
    study.output = "out/" + (study.cell_files.size() == 1
                               ? std::filesystem::path(study.cell_files[0]).stem().string()
                               : std::string("strain"));
  const std::vector<Verdict> verdicts = run_strain_study(study, MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
  {
    if (!study.quiet)
      for (const Verdict &verdict : verdicts)
        std::printf("%-12s %s: %.3g (%s)\n", name_of(verdict.outcome).c_str(),
                    verdict.claim.c_str(), verdict.value, verdict.limit.c_str());
    if (!arguments.no_report)
      afterwards = [output = study.output, quiet = study.quiet]()
      { make_report({output}, output, quiet); };
  }
  return any_failed(verdicts) ? 1 : 0;
}
} // namespace

void make_report(const std::vector<std::string> &folders, const std::string &output,
                 const bool quiet)
{
  const std::string in_sources =
    std::string(HOMESPUN_SOURCE_DIR) + "/verification/report/report.py";
  const std::string script       = std::filesystem::exists(in_sources)
                                     ? in_sources
                                     : std::string(HOMESPUN_DATA_DIR) + "/report/report.py";
  std::vector<std::string> words = {HOMESPUN_PYTHON, script};
  words.insert(words.end(), folders.begin(), folders.end());
  words.insert(words.end(), {"--output", output});
  std::vector<char *> arguments;
  for (std::string &word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);

  // mpirun binds a rank to one core, and a child inherits that.
  cpu_set_t all_cores;
  std::memset(&all_cores, 0xff, sizeof(all_cores));
  sched_setaffinity(0, sizeof(all_cores), &all_cores);

  pid_t child = 0;
  int status  = 0;
  if (posix_spawn(&child, HOMESPUN_PYTHON, nullptr, nullptr, arguments.data(), environ) != 0 ||
      waitpid(child, &status, 0) != child || !WIFEXITED(status))
    throw meshes::BadInput(
      std::string(HOMESPUN_PYTHON) + " " + script +
      ": cannot be run; expected Debian's Python with numpy, h5py, matplotlib and "
      "jinja2: ./bootstrap installs them");
  if (WEXITSTATUS(status) != 0)
    throw meshes::BadInput("the report could not be made, see above; the results are in " +
                           folders[0] + ": mend them, then `homespun report " + folders[0] + "`");
  if (!quiet)
    std::printf("Report: %s/report.html\n", output.c_str());
}

void add_strain_command(CLI::App &app, Action &action, Afterwards &afterwards,
                        const std::string &command_line)
{
  CLI::App *command = app.add_subcommand(
    "strain", "Error against strain (Figure 3): up-sampled cloth held against the resolved one");
  const auto arguments      = std::make_shared<StrainArguments>();
  StrainStudyOptions &study = arguments->study;
  study.strains             = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2};
  study.loads               = Load::names();
  study.references          = {"linear", "biot", "green"};
  study.methods             = Method::names();
  study.command             = command_line;

  command->add_option("CELL.prm", study.cell_files, "Cell files")->required();
  CLI::Option *cells =
    command->add_option("--cells", study.n_cells, "Cells per side of the sheet; the paper has 20")
      ->check(CLI::Range(1, 200))
      ->capture_default_str();
  CLI::Option *strains =
    command
      ->add_option("--strains", study.strains, "Strains as fractions, 0.1 is 10 %, comma-separated")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  command->add_option("--loads", study.loads, "Loads, comma-separated")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->capture_default_str();
  command->add_option("--references", study.references, "Laws of the fine reference")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->capture_default_str();
  command->add_option("--methods", study.methods, "Ways to the fine positions")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->capture_default_str();
  command->add_option("--output", study.output,
                      "Folder of the results (default out/NAME, out/strain for several cells)");
  command->add_flag("--quick", arguments->quick,
                    "4 x 4 cells at 0.1, 1 and 10 % unless given otherwise: seconds");
  command->add_flag("--resume", study.resume, "Keep the rows that are there, compute the rest");
  command->add_flag("--quiet", study.quiet, "Print nothing but faults");
  command->add_flag("--no-report", arguments->no_report, "Leave out report.html");
  command->footer(
    "Loads: periodic-11, periodic-22, periodic-12 (infinite cloth; 12 is simple shear), strip-1,\n"
    "strip-2 (two edges clamped, one pulled outwards), shear-frame (upper edge moved sideways).\n"
    "References: linear; biot (what the coarse cloth approximates); green (St. Venant-Kirchhoff).\n"
    "Example:\n  homespun strain mycell.prm --quick\n"
    "  mpirun -n 2 homespun strain mycell.prm --loads strip-2,shear-frame --strains 0.01,0.1");
  command->callback(
    [&action, &afterwards, arguments, cells, strains]()
    {
      if (arguments->quick)
      {
        if (cells->count() == 0)
          arguments->study.n_cells = 4;
        if (strains->count() == 0)
          arguments->study.strains = {0.001, 0.01, 0.1};
        arguments->study.n_cells_of_error_bar = 2;
      }
      action = [&afterwards, arguments]() { return run_strain(*arguments, afterwards); };
    });
}

void add_report_command(CLI::App &app, Action &action, Afterwards &afterwards)
{
  CLI::App *command =
    app.add_subcommand("report", "Make report.html and the figures again from stored results");
  struct Arguments
  {
    std::vector<std::string> folders;
    std::string output;
    bool quiet = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("DIR", arguments->folders, "Folders of results")->required();
  command->add_option("--output", arguments->output,
                      "Folder of the report (default the first DIR)");
  command->add_flag("--quiet", arguments->quiet, "Print nothing but faults");
  command->callback(
    [&action, &afterwards, arguments]()
    {
      action = [&afterwards, arguments]()
      {
        if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          afterwards = [arguments]()
          {
            make_report(arguments->folders,
                        arguments->output.empty() ? arguments->folders[0] : arguments->output,
                        arguments->quiet);
          };
        return 0;
      };
    });
}
} // namespace homespun::verification
