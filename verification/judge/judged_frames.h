// SPDX-License-Identifier: MIT
#pragma once

#include "verification/judge/judged_run.h"

#include <vector>

namespace homespun::verification
{
/// Judges positions against the references of a `drape --keep`: rows of drape.csv, beside those of
/// the cloth that is the method's, and claims.
/// @return the claims on the method
/// @throws BadInput with a message per file whose positions cannot be judged, and nothing written
std::vector<Verdict> judge_frames(JudgedRun &given);
} // namespace homespun::verification
