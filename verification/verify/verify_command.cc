// SPDX-License-Identifier: MIT
// homespun verify: everything, for a list of cells.
#include "verification/verify/verify_command.h"

#include "verification/command/report_script.h"
#include "verification/command/study_arguments.h"
#include "verification/record/on_root.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace homespun::verification
{
namespace
{
void check_verify_arguments(const VerifyOptions &options)
{
  ArgumentFaults faults;
  faults.check_names("--parts", options.parts, verify_parts());
  for (const std::string &part : options.parts)
    if (options.cell_files.empty() && part != "stress")
      faults.add("--parts: " + part +
                 " needs a cell, and none is given; expected CELL.prm, or the "
                 "part stress");
  faults.throw_if_any();
}

int run_verify(StudyArguments<VerifyOptions> arguments, CommandLine &line)
{
  VerifyOptions &options = arguments.study;
  choose_folder(*line.app.get_subcommand("verify"), options.cell_files, options);
  const bool tells = is_root(MPI_COMM_WORLD);
  Verification result;
  try
  {
    result = line.studies.run<VerifyCommand>(options, MPI_COMM_WORLD);
  }
  catch (const meshes::BadInput &bad)
  {
    // The first line of the answer, whoever reads only that.
    if (tells)
      std::printf("FAIL: %s\n", bad.faults().front().c_str());
    throw;
  }
  if (tells)
  {
    // Whoever asked for silence hears of what failed alone.
    const std::string outcome = outcome_line(result.verdicts);
    if (outcome.rfind("FAIL", 0) == 0 &&
        (result.status == exit_status::good || result.status == exit_status::claim_open))
      throw std::logic_error("the exit status hides a claim that failed; please report this: " +
                             outcome);
    if (!options.quiet || outcome.rfind("FAIL", 0) == 0)
      std::printf("%s\n", outcome.c_str());
    if (!options.quiet)
      print(result.verdicts, arguments.end);
    if (!arguments.end.no_report)
    {
      // The first folder holds the claims of all parts, those too of a part that did not run to its
      // end.
      std::vector<std::string> folders = {options.output};
      folders.insert(folders.end(), result.folders.begin(), result.folders.end());
      line.afterwards = [folders, output = options.output, quiet = options.quiet]()
      {
        make_report(folders, output, quiet);
        list_report(output);
        return 0;
      };
    }
  }
  return result.status;
}
} // namespace

void VerifyCommand::add(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "verify", "Every study of a list of cells: one report with all claims; without a cell the "
              "stability map of made cells");
  const auto arguments   = std::make_shared<StudyArguments<VerifyOptions>>();
  VerifyOptions &options = arguments->study;
  options.command        = line.text;
  command->add_option("CELL.prm", options.cell_files,
                      "Cell files; none: made cells, part stress alone");
  add_list(*command, "--parts", options.parts,
           "What to run, comma-separated (default: all with cells, stress without)");
  add_folder_options(*command, options,
                     "out/NAME/verify, without a cell out/verify, with --quick verify-quick");
  command->add_flag("--quick", options.is_quick, "Small sizes everywhere: minutes");
  add_end_options(*command, arguments->end);
  command->footer(
    "Parts: homogenize (brackets of C^H), strain (error against strain, budget, run time, range of "
    "validity),\n"
    "bend (bent sheets, onset of wrinkles), load (pulled by 5 %), stability (pressed), converge "
    "(observed orders), stress (stability "
    "map), drape\n"
    "(hang and pull in motion against biot).\n"
    "The first line says PASS, or FAIL with the first claim that failed; each part has a folder of "
    "its own.\n"
    "Each cell is homogenized for itself and once for all studies, which hand it on.\n"
    "Without a cell the stability map of made cells is drawn, once for each version; pages of "
    "cells "
    "link it.\n"
    "Example:\n  homespun verify mycell.prm --quick\n  homespun verify --quick\n  mpirun -n 2 "
    "homespun verify mycell.prm");
  command->callback(
    [&line, arguments]()
    {
      line.check = [arguments]() { check_verify_arguments(arguments->study); };
      line.solve = [&line, arguments]() { return run_verify(*arguments, line); };
    });
}
} // namespace homespun::verification
