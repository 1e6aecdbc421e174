// SPDX-License-Identifier: MIT
// An infinite cloth under stresses and strains that are prescribed component by component: its
// curve, against that of a cloth that has C^H in place of the microstructure.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/load/load_control.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
struct LoadStudyOptions : StudyOptions
{
  LoadControl control;
  int n_steps = 20;
  /// Beside `linear`, which is always there; none: the default of each cell.
  std::vector<std::string> laws;
  std::vector<std::string> measured; ///< CSV files
};

/// Solves all paths on the first rank, writes load.csv, measured.csv where there is any, study.json
/// and verdicts.json. Paths are short: a run that goes on solves all of them again.
/// @throws BadInput, NotConverged where the cell cannot be homogenized
std::vector<Verdict> run_load_study(const LoadStudyOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
