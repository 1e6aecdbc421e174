// SPDX-License-Identifier: MIT
// How time and memory of the cell problems grow with the mesh and fall with the ranks, on the
// machine at hand.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/record/verdict.h"
#include "verification/scaling/scaling_tables.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// One cell file.
struct ScalingOptions : StudyOptions
{
  std::vector<int> refinements = {3, 4, 5};
  std::vector<int> ranks       = {1, 2, 4};
  int order                    = 1;
  int repeats                  = 3;
  /// What runs a program on several ranks; {ranks} stands for their number.
  std::string launcher = "mpirun --oversubscribe -n {ranks}";
  int cores = 0; ///< that ranks can have to themselves; with more ranks times are not modelled. 0:
                 ///< those of this machine
};

struct ScalingResult
{
  std::vector<ScalingRun> runs;
  std::vector<Verdict> verdicts;
};

/// Runs what is asked for, each in a process of its own, and writes scaling.csv row by row, then
/// scaling.json and verdicts.json. To be called where MPI is not running.
/// @throws BadInput where the cell cannot be read, or the launcher cannot be run; NotConverged
ScalingResult run_scaling_study(const ScalingOptions &options);
} // namespace homespun::verification
