// SPDX-License-Identifier: MIT
// Studies of an infinite cloth. `load`: under stresses and strains that are prescribed component by
// component, its curve against that of a cloth that has C^H in place of the microstructure.
// `stability`: where the cells start to buckle in their plane, the Bloch margin along loads and
// the strain of first loss.
#pragma once

#include "verification/periodic/periodic_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <vector>

namespace homespun::verification
{
/// Solves all paths on the first rank, writes load.csv, study.json and verdicts.json. Paths are
/// short: a run that goes on solves all of them again.
/// @throws BadInput, NotConverged where the cell cannot be homogenized
std::vector<Verdict> run_load_study(const LoadStudyOptions &options, MPI_Comm communicator);

/// Solves on the first rank; writes stability.csv path by path, study.json and
/// verdicts.json. Paths that the same run had finished are taken up.
/// @throws BadInput, NotConverged where the cell cannot be homogenized
std::vector<Verdict> run_stability_study(const StabilityStudyOptions &options,
                                         MPI_Comm communicator);
} // namespace homespun::verification
