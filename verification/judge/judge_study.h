// SPDX-License-Identifier: MIT
// Somebody's own fine positions held against the references that a study kept. The result is
// a folder with that study, to which the method has come as one more.
#pragma once

#include "verification/judge/judge_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <vector>

namespace homespun::verification
{
/// Writes the folder of the result. First rank.
/// @return the claims on the method
/// @throws BadInput with a message per file whose positions cannot be judged, and nothing written
std::vector<Verdict> judge(const JudgeOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
