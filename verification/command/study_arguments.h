// SPDX-License-Identifier: MIT
// What the commands that run a study share: lists on the command line, faults of names collected
// over all options, the options that all have, and the end: verdicts on the terminal, the report,
// the exit status.
#pragma once

#include "meshes/plain/errors.h"
#include "verification/cell/study_options.h"
#include "verification/command/command.h"
#include "verification/method/method.h"
#include "verification/record/run_folder.h"
#include "verification/record/verdict.h"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <array>
#include <memory>
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

  /// Writes each of --methods in the one order of its terms. A name of version 0.1 becomes what it
  /// is called now, which is told unless the study is quiet.
  /// @param without_meaning terms that do nothing in the study: methods that differ in them alone
  ///   are the same, and nobody may ask for them by name
  void read_methods(StudyOptions &study, std::vector<std::string> &methods,
                    const std::vector<Term> &without_meaning = {});

  /// The same of --variants of a scene, which are laws.
  void read_variants(const StudyOptions &study, std::vector<std::string> &variants);

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
    "Resume the run in the folder, which is the default, and refuse any other run there");
  command
    .add_flag_callback(
      "--overwrite", [&study]() { study.earlier = Earlier::overwrite; },
      "Start again, whatever run the folder holds and however long that took")
    ->excludes(resume);
  command.add_flag("--quiet", study.quiet, "Print errors only");
}

/// The words of a command line, with lists that blanks parted joined again: `--loads a, b` is
/// `--loads a,b`.
/// @param words without the name of the program
std::vector<std::string> joined_lists(const std::vector<std::string> &words);

/// The names of files without folders and endings.
std::vector<std::string> stems(const std::vector<std::string> &files);

/// How a study ends on the terminal.
struct EndOfStudy
{
  bool no_report  = false;
  bool is_verbose = false; ///< also the claims that hold, each in a line
};

/// Claims on the terminal, a line each: those that failed or are open, or all.
void print(const std::vector<Verdict> &verdicts, const EndOfStudy &end);

/// How many claims hold, failed and are open, in one line.
std::string count_of_claims(const std::vector<Verdict> &verdicts);

/// What a command that runs a study is told: the study's options, and what is no study's matter.
template <typename Options>
struct StudyArguments
{
  Options study;
  EndOfStudy end;
};

/// What a command says of itself below its options.
struct StudyText
{
  std::string place;  ///< what the folder is by default, in words: "out/NAME/strain"
  std::string footer; ///< what follows the options in its help
};

/// Adds --no-report and --verbose.
void add_end_options(CLI::App &command, EndOfStudy &end);

/// Gives a study the folder of its command and inputs, where it was told none.
void choose_folder(const CLI::App &command, const std::vector<std::string> &input_files,
                   StudyOptions &study);

/// Prints, on the first rank, the claims that do not hold, and leaves the page to be made, whose
/// answer and the number of claims are the last that is printed.
/// @return the exit status: status_of() the verdicts
int conclude(CommandLine &line, const std::vector<Verdict> &verdicts, const StudyOptions &study,
             const EndOfStudy &end);

/// The rest of a command that runs a study: the options that all have and, where it is chosen, what
/// it checks, its folder, the study, its verdicts and its page.
/// @tparam Command whose run() returns verdicts
/// @param arguments of a kind derived from StudyArguments
/// @param check is called with the arguments, may change them and throws BadInput
template <typename Command, typename Arguments, typename Check>
void add_study(CommandLine &line, CLI::App &command, const std::shared_ptr<Arguments> &arguments,
               const StudyText &text, const Check &check)
{
  arguments->study.command = line.text;
  add_folder_options(command, arguments->study, text.place);
  add_end_options(command, arguments->end);
  command.footer(text.footer);
  command.callback(
    [&line, &command, arguments, check]()
    {
      line.check = [arguments, check]() { check(*arguments); };
      line.solve = [&line, &command, arguments]()
      {
        auto &study = arguments->study;
        choose_folder(command, study.cell_files, study);
        return conclude(line, line.studies.template run<Command>(study, MPI_COMM_WORLD), study,
                        arguments->end);
      };
    });
}
} // namespace homespun::verification
