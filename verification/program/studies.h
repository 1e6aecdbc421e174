// SPDX-License-Identifier: MIT
// What the commands run: the studies, which need finite elements. The command line names none of
// them, so that a program without deal.II can have it: `homespun` itself, which answers at once
// what needs no study and hands all else over to `homespun-full`.
#pragma once

#include "verification/bloch/stability_study.h"
#include "verification/converge/converge_study.h"
#include "verification/drape/drape_study.h"
#include "verification/extremes/stress_study.h"
#include "verification/load/load_study.h"
#include "verification/program/homogenize_command.h"
#include "verification/program/verify_study.h"
#include "verification/record/verdict.h"
#include "verification/strain/strain_study.h"

#include <mpi.h>

#include <functional>
#include <vector>

namespace homespun::verification
{
/// A study: from its options to its claims, on all ranks.
template <typename Options>
using Study = std::function<std::vector<Verdict>(const Options &, MPI_Comm)>;

/// All studies, or none of them in a program that hands over.
struct Studies
{
  std::function<int(const HomogenizeArguments &)> homogenize; ///< returns the exit status
  Study<StrainStudyOptions> strain;
  Study<DrapeOptions> drape;
  Study<StressStudyOptions> stress;
  Study<ConvergenceStudyOptions> converge;
  Study<LoadStudyOptions> load;
  Study<StabilityStudyOptions> stability;
  std::function<Verification(const VerifyOptions &, MPI_Comm)> verify;
};
} // namespace homespun::verification
