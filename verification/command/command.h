// SPDX-License-Identifier: MIT
// A command of the program: what it adds to the command line, what it runs, which tables that
// leaves. A command is a struct like
//
//     struct LoadCommand
//     {
//       using Options = LoadStudyOptions;
//       using Tables  = TablesOf<LoadRow, MeasuredRow>;   // for the report
//       static void add(CommandLine &line);
//       static constexpr auto run = run_load_study;       // from Options and ranks to its claims
//     };
//
// in a folder with its study, and a name in the list of program/all_commands.h.
#pragma once

#include "verification/record/schema.h"

#include <CLI/App.hpp>
#include <mpi.h>

#include <any>
#include <functional>
#include <map>
#include <string>
#include <typeindex>

namespace homespun::verification
{
/// What the chosen command does, made by the command line.
using Action = std::function<int()>;

/// What is left to do when MPI has ended, on the first rank: the report, which is drawn by several
/// processes and needs the cores that idle ranks would keep busy, or runs of mpirun. Returns an
/// exit status.
using AfterMpi = std::function<int()>;

/// What the commands run. A program without deal.II has none of them: `homespun` itself, which
/// answers at once what needs no study and hands all else over to `homespun-full`. So a command
/// names what it runs by its own type and not by the function, which would be linked.
class Studies
{
public:
  template <typename Command>
  void add()
  {
    runs[typeid(Command)] = Command::run;
  }

  /// Runs a command on all ranks.
  template <typename Command>
  auto run(const typename Command::Options &options, const MPI_Comm communicator) const
  {
    using Run = std::decay_t<decltype(Command::run)>;
    return std::any_cast<Run>(runs.at(typeid(Command)))(options, communicator);
  }

private:
  std::map<std::type_index, std::any> runs;
};

/// What the commands add themselves to, and where the chosen one leaves what it checks, and its
/// work in one of three places.
struct CommandLine
{
  CLI::App &app;
  const Studies &studies;
  const std::string text; ///< the command line, for the records

  std::function<void()> check; ///< before all else: throws BadInput of the command line
  Action solve;                ///< with MPI
  Action without_mpi;          ///< on one process without MPI, on the ranks of a launcher with it
  Action at_once; ///< as `without_mpi`, and leaves no record of a run: needs no deal.II
  AfterMpi afterwards;
};

/// A command that runs no study and leaves no table.
struct CommandOfNoStudy
{
  using Tables              = TablesOf<>;
  static constexpr auto run = nullptr;
};
} // namespace homespun::verification
