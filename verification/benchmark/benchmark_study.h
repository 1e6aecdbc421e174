// SPDX-License-Identifier: MIT
// What the machine at hand makes of the work that users wait for, in about a minute: the cell
// problems, a step of the coarse cloth with its parts, up-sampling, each beside how fast the
// machine copies and multiplies in the same run. Times are told and never judged.
#pragma once

#include "verification/benchmark/benchmark_tables.h"
#include "verification/record/earlier.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
struct BenchmarkOptions
{
  std::string cell_file, scene_file;
  int refine = 4; ///< uniform refinements of the cell for its problems
  int runs   = 5; ///< of each part
  std::string output;
  std::string command;
  Earlier earlier = Earlier::overwrite;
  bool quiet      = false;
};

/// Runs all parts and writes benchmark.csv and benchmark.json. The cell problems are solved by all
/// ranks, all else is measured on the first one, on one thread.
/// @return the rows, on the first rank
/// @throws BadInput where cell or scene cannot be read; NotConverged
std::vector<BenchmarkRow> run_benchmark(const BenchmarkOptions &options, MPI_Comm communicator);

/// A table for the terminal.
std::string table_of(const std::vector<BenchmarkRow> &rows);
} // namespace homespun::verification
