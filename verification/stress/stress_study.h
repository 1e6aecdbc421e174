// SPDX-License-Identifier: MIT
// All stress cases, each repeated, as a table with verdicts.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Without cells: built-in ones.
struct StressStudyOptions : StudyOptions
{
  int repeats        = 10;
  int most_triangles = 1000000; ///< of the largest cell
};

/// Each case twice, cells of at most 1e5 triangles.
inline void make_quick(StressStudyOptions &options)
{
  options.is_quick       = true;
  options.repeats        = 2;
  options.most_triangles = 100000;
}

/// Runs all cases and writes, into the output folder, stress.csv and solver.csv row by row,
/// verdicts.json and study.json. Cases and measurements that have a row there are not run again.
/// Cells are homogenized with P1 by all ranks; the cases run on the first rank, on one thread.
/// @throws BadInput, NotConverged of the cells, BadInput of the folder; what a case throws is its
/// outcome
std::vector<Verdict> run_stress_study(const StressStudyOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
