// SPDX-License-Identifier: MIT
// homespun converge: every number that a study of this program rests on, on a ladder of at least
// four levels, with its observed order held against the order that theory says.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
struct ConvergenceStudyOptions : StudyOptions
{
  std::vector<std::string> studies; ///< of convergence_studies()
};

/// Runs the studies and writes, into the output folder, converge.csv (a row per level of every
/// series, per claim and per complete case), verdicts.json and study.json. What a case needs is on
/// the disk when it is complete, and complete cases of the same run are not run again. A case whose
/// solver does not converge FAILs with the reason (INCONCLUSIVE where its load may have no
/// equilibrium), keeps the levels that were solved, and is run again.
/// @throws BadInput
std::vector<Verdict> run_convergence_study(const ConvergenceStudyOptions &options,
                                           MPI_Comm communicator);
} // namespace homespun::verification
