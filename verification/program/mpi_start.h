// SPDX-License-Identifier: MIT
// MPI, as a process starts it that no launcher did, beside any number of others: without a trace,
// and with an exit status of ours where it fails.
#pragma once

#include <deal.II/base/mpi.h>

#include <array>
#include <optional>

namespace homespun::verification
{
/// MPI, for as long as this lives. With one thread per rank.
class Mpi
{
public:
  /// Starts MPI where it does not run. Where Open MPI cannot start it gives its reason and ends the
  /// process: with exit status 3, not with its own 1, which is that of a claim that failed.
  /// @param name of the program. The command line is not handed on: PETSc, which deal.II starts
  ///   with MPI, would take our options for its own and warn of them at the end.
  /// @throws NotConverged where no temporary folder can be made
  void start(char *name);

private:
  int n_arguments = 1;
  std::array<char *, 2> arguments{};
  char **first_argument = arguments.data();
  std::optional<dealii::Utilities::MPI::MPI_InitFinalize> running;
};
} // namespace homespun::verification
