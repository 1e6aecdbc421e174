// SPDX-License-Identifier: MIT
// What the commands that run a study share: lists on the command line, faults of names collected
// over all options, and the end of a command: verdicts on the terminal, the report, the exit
// status.
#pragma once

#include "meshes/plain/errors.h"
#include "verification/program/commands.h"
#include "verification/record/run_folder.h"
#include "verification/record/verdict.h"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// An option that takes a comma-separated list; the present content is the default.
template <typename Value>
CLI::Option *add_list(CLI::App &command, const char *option, std::vector<Value> &values,
                      const std::string &text)
{
  CLI::Option *added =
    command.add_option(option, values, text)->delimiter(',')->allow_extra_args(false);
  return values.empty() ? added : added->capture_default_str();
}

/// What is wrong with the arguments, said all at once.
class ArgumentFaults
{
public:
  void add(const std::string &fault)
  {
    faults.push_back(fault);
  }

  /// Makes of each name what it stands for; a name that cannot be made is a fault of the option.
  /// @param make throws BadInput that lists the names there are
  template <typename Make>
  void check_names(const std::string &option, const std::vector<std::string> &names,
                   const Make &make)
  {
    for (const std::string &name : names)
      try
      {
        static_cast<void>(make(name));
      }
      catch (const meshes::BadInput &bad)
      {
        add(option + ": " + bad.what());
      }
  }

  /// Each name must be one of those that are known.
  void check_names(const std::string &option, const std::vector<std::string> &names,
                   const std::vector<std::string> &known);

  /// @throws BadInput with one message per fault
  void throw_if_any() const
  {
    if (!faults.empty())
      throw meshes::BadInput(faults);
  }

private:
  std::vector<std::string> faults;
};

/// Reads the numbers of cells of `2x2`; nothing where nothing was said, or it is a fault.
std::optional<std::array<int, 2>> read_supercell(const std::string &text, ArgumentFaults &faults);

/// Adds --output, --resume, --overwrite and --quiet.
/// @param study has `output`, `earlier` and `quiet`
/// @param place what the folder is by default, in words: "out/NAME/strain"
template <typename Study>
void add_folder_options(CLI::App &command, Study &study, const std::string &place)
{
  command.add_option("--output", study.output,
                     "Folder of the results, which is one run (default " + place + ")");
  CLI::Option *resume = command.add_flag_callback(
    "--resume", [&study]() { study.earlier = Earlier::resume; },
    "Go on with the run in the folder, as without it, and refuse any other run there");
  command
    .add_flag_callback(
      "--overwrite", [&study]() { study.earlier = Earlier::overwrite; },
      "Begin anew, whatever run the folder holds, however long that took")
    ->excludes(resume);
  command.add_flag("--quiet", study.quiet, "Print nothing but faults");
}

/// The words of a command line, with lists that blanks parted joined again: `--loads a, b` is
/// `--loads a,b`.
/// @param words without the name of the program
std::vector<std::string> joined_lists(const std::vector<std::string> &words);

/// The names of files without folders and endings.
std::vector<std::string> stems(const std::vector<std::string> &files);

/// The verdicts on the terminal, a line each.
void print(const std::vector<Verdict> &verdicts);

/// What every study is told apart from its subject.
struct StudyEnd
{
  bool no_report = false;

  /// Adds --no-report.
  void add_options(CLI::App &command);

  /// Prints the verdicts and leaves the report of the output folder to be made, both on the first
  /// rank.
  /// @return the exit status: status_of() the verdicts
  int conclude(const std::vector<Verdict> &verdicts, const std::string &output, bool quiet,
               AfterMpi &afterwards) const;
};
} // namespace homespun::verification
