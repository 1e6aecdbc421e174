// SPDX-License-Identifier: MIT
#include "verification/program/command_line.h"

#include "meshes/plain/errors.h"
#include "verification/command/study_arguments.h"
#include "verification/program/all_commands.h"
#include "verification/program/command_faults.h"
#include "verification/record/on_root.h"
#include "verification/record/verdict.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

namespace homespun::verification
{
namespace
{
void add_commands(CommandLine &line)
{
  line.app.require_subcommand(1);
  line.app.footer(
    "Exit status, the worst in this order: 5 a fault of homespun itself; 2 bad input; 3 a solver "
    "did not converge where\nit had to; 1 a claim failed; 4 a claim is open; 0 all claims hold. "
    "Claims are of "
    "the program, of the input, or of the method.\n`homespun COMMAND --help` teaches a "
    "command; `mpirun -n N homespun ...` works for every command that solves.");
  AllCommands::add_to(line);
}

/// The words with what had another name in version 0.1 as it is called now.
/// @param told what was renamed
std::vector<std::string> with_new_names(std::vector<std::string> words,
                                        std::vector<std::string> &told)
{
  const auto rename = [&](std::string &word, const std::string &old, const std::string &now)
  {
    if (word.substr(0, word.find('=')) != old)
      return;
    word = now + word.substr(old.size());
    told.push_back("`" + old + "` is `" + now + "` now; this version still takes the old name");
  };
  if (!words.empty() && (words[0] == "load" || words[0] == "stability"))
  {
    told.push_back("`homespun " + words[0] + "` is `homespun periodic " + words[0] +
                   "` now; this version still takes the old name");
    words.insert(words.begin(), "periodic");
  }
  if (!words.empty() && words[0] == "periodic")
    for (std::string &word : words)
    {
      rename(word, "--load", "--loads");
      rename(word, "--law", "--references");
    }
  return words;
}

/// What was chosen, when all that it needs is there.
const Action &chosen(const CommandLine &line, const Program &program)
{
  if (line.check)
    line.check();
  if (line.at_once)
    return line.at_once;
  if (program.before_records)
    program.before_records();
  if (line.without_mpi)
    return line.without_mpi;
  if (program.before_solving)
    program.before_solving();
  return line.solve;
}

/// What may have happened to this rank alone, for which the others would wait without end.
int ended_alone(const std::string &why, const int status)
{
  std::cerr << "homespun: " << why << std::endl;
  if (n_ranks_of(MPI_COMM_WORLD) > 1)
    MPI_Abort(MPI_COMM_WORLD, status);
  return status;
}
} // namespace

bool is_launched()
{
  for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (std::getenv(name))
      return true;
  return false;
}

int guarded(const Action &action, const bool tells)
{
  try
  {
    return action();
  }
  catch (const meshes::BadInput &bad)
  {
    if (tells)
      for (const std::string &fault : bad.faults())
        std::cerr << "homespun: " << fault << "\n";
    return exit_status::bad_input;
  }
  catch (const std::filesystem::filesystem_error &error)
  {
    if (tells)
      std::cerr << "homespun: " << error.what()
                << "; expected a folder that can be written: choose "
                << "another --output\n";
    return exit_status::bad_input;
  }
  catch (const meshes::NotConverged &failure)
  {
    if (tells)
      std::cerr << "homespun: " << failure.what() << "\n";
    return exit_status::not_converged;
  }
  catch (const FirstRankAtFault &)
  {
    MPI_Barrier(MPI_COMM_WORLD); // the first rank tells, and ends all
    return exit_status::program_fault;
  }
  catch (const std::bad_alloc &)
  {
    return ended_alone("the memory of this machine does not suffice; expected a coarser mesh or "
                       "fewer cells",
                       exit_status::bad_input);
  }
  catch (const std::exception &fault)
  {
    return ended_alone(std::string("a fault of homespun itself, or numbers beyond its arithmetic; "
                                   "please report it with the command and its input: ") +
                         fault.what(),
                       exit_status::program_fault);
  }
}

int run_command_line(const std::vector<std::string> &words_given, const Program &program,
                     AfterMpi &afterwards)
{
  std::vector<std::string> told;
  const std::vector<std::string> arguments = with_new_names(words_given, told);
  const bool is_root                       = verification::is_root(MPI_COMM_WORLD);
  const unsigned int n_ranks               = n_ranks_of(MPI_COMM_WORLD);
  std::string text                         = "homespun";
  for (const std::string &word : arguments)
    text += " " + word;
  if (n_ranks > 1)
    text = "mpirun -n " + std::to_string(n_ranks) + " " + text;

  CLI::App app(
    "homespun tells how far an up-sampled cloth is from the resolved one, and where the error\n"
    "comes from. A periodic unit cell is homogenized once, a coarse cloth moves with the\n"
    "effective stiffness, the fine mesh is restored from it and compared with the resolved one.",
    "homespun");
  app.set_version_flag("--version", program.version);
  CommandLine line{app, program.studies, text, {}, {}, {}, {}, {}};
  add_commands(line);
  const std::vector<std::string> given = joined_lists(arguments);
  try
  {
    std::vector<std::string> words = given;
    std::reverse(words.begin(), words.end()); // as CLI11 takes them
    app.parse(words);
  }
  catch (const CLI::ParseError &error)
  {
    const bool is_fault = error.get_exit_code() != 0;
    if (is_root && is_fault)
      std::cerr << "homespun: " << command_fault(app, given, error) << "\n";
    else if (is_root)
      app.exit(error, std::cout, std::cerr);
    return is_fault ? exit_status::bad_input : exit_status::good;
  }
  // Of two programs that read one command line, the one that solves tells.
  if (is_root && program.before_solving)
    for (const std::string &text_of_one : told)
      std::cerr << "homespun: " << text_of_one << "\n";
  const int status = guarded([&]() { return chosen(line, program)(); }, is_root);
  afterwards       = std::move(line.afterwards);
  // A launcher ends all ranks when one of them ends with another status than zero, and the first
  // one may have a report to make yet: what the claims come to is its word alone.
  const bool is_of_claims =
    status == exit_status::claim_failed || status == exit_status::claim_open;
  return is_of_claims && !is_root ? exit_status::good : status;
}
} // namespace homespun::verification
