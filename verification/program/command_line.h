// SPDX-License-Identifier: MIT
// The command line and what the exit status means: one for the program that answers at once and for
// the one that solves.
#pragma once

#include "verification/command/command.h"

#include <functional>
#include <string>

namespace homespun::verification
{
/// Which of the two programs reads the command line.
struct Program
{
  Studies studies;
  std::function<void()> before_records; ///< called before a command that leaves records of a run
  std::function<void()> before_solving; ///< called before a command that solves, after the former
  std::function<std::string()> version;
};

/// Whether mpirun, srun or the like started this process, as one of several perhaps.
bool is_launched();

/// Runs an action; every rank meets the same faults, one tells.
/// @param tells whether this one does
/// @return its exit status, or that of the fault that it met
int guarded(const Action &action, bool tells);

/// Reads the command line and runs the command.
/// @param arguments without the name of the program
/// @param afterwards receives what is left to do when MPI has ended
/// @return the exit status
int run_command_line(const std::vector<std::string> &arguments, const Program &program,
                     AfterMpi &afterwards);
} // namespace homespun::verification
