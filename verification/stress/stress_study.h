// SPDX-License-Identifier: MIT
// The stability map: every axis climbed until an answer is wrong, as tables with claims.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Without cells: made ones.
struct StressStudyOptions : StudyOptions
{
  int most_triangles = 1000000; ///< of the largest cell
  double longest     = 10.;     ///< beyond what is owed a value that takes longer ends its axis [s]
};

/// Cells of at most 1e4 triangles; beyond what is owed, values of at most 2 s.
inline void make_quick(StressStudyOptions &options)
{
  options.is_quick       = true;
  options.most_triangles = 10000;
  options.longest        = 2.;
}

/// Climbs all axes and writes, into the output folder, stress.csv value by value, limits.csv axis
/// by axis, verdicts.json and study.json. Axes that have a row there are not climbed again. It runs
/// on the first rank, on one thread; cells are homogenized by all ranks once more.
/// @throws BadInput of cells and folder; what a value throws ends its axis
std::vector<Verdict> run_stress_study(const StressStudyOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
