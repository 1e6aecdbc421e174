// SPDX-License-Identifier: MIT
// How time and memory of the cell problems grow with the mesh and fall with the ranks, on the machine at hand.
#pragma once

#include "verification/verdict.h"

#include <string>
#include <vector>

namespace homespun::verification
{
struct ScalingOptions
{
  std::string cell_file;
  std::vector<int> refinements = {3, 4, 5};
  std::vector<int> ranks       = {1, 2, 4};
  int order                    = 1;
  int repeats                  = 3;
  /// What runs a program on several ranks; {ranks} stands for their number.
  std::string launcher = "mpirun --oversubscribe -n {ranks}";
  int cores =
    0; ///< that ranks can have to themselves; with more ranks times are not modelled. 0: those of this machine
  std::string output;
  std::string command;
  bool resume = false, quiet = false;
};

/// One run of `homespun homogenize --no-bars`.
struct ScalingRun
{
  int refine = 0, ranks = 0, repeat = 0;
  double dofs       = 0.;
  double iterations = 0.;                                            ///< mean of the three loads
  double setup = 0., assembly = 0., preconditioner = 0., solve = 0.; ///< [s], of the slowest rank
  double largest_rank = 0., all_ranks = 0.;                          ///< peak memory [bytes]
  std::vector<double> stiffness; ///< C11 C12 C13 C22 C23 C33 [N/m]

  double seconds() const
  {
    return setup + assembly + preconditioner + solve;
  }
};

/// The memory of the largest rank as a + b n/p, and the time as n (s + w/p), n DoFs on p ranks: least squares of the
/// relative misfit. What the first model leaves out is said beside it.
struct ScalingModel
{
  double bytes_per_rank = 0., bytes_per_dof = 0., memory_misfit = 0.;
  double serial_seconds_per_dof = 0., seconds_per_dof = 0., time_misfit = 0.;
};

/// @param runs of two meshes and two numbers of ranks at the least
/// @param cores runs on more ranks than these do not count in the time
ScalingModel model_of(const std::vector<ScalingRun> &runs, int cores);

/// C^H does not depend on the ranks, iterations not on the mesh, and the memory of a rank on the finest mesh falls with
/// their number.
std::vector<Verdict> verdicts_of(const std::vector<ScalingRun> &runs);

/// A table for the terminal: medians of the repeats, with the least and the largest.
std::string table_of(const std::vector<ScalingRun> &runs);

struct ScalingResult
{
  std::vector<ScalingRun> runs;
  std::vector<Verdict> verdicts;
};

/// Runs what is asked for, each in a process of its own, and writes scaling.csv row by row, then scaling.json and
/// verdicts.json. To be called where MPI is not running.
/// @throws BadInput where the cell cannot be read, or the launcher cannot be run; NotConverged
ScalingResult run_scaling_study(const ScalingOptions &options);
} // namespace homespun::verification
