// SPDX-License-Identifier: MIT
// Everything that a strain study claims of its tables, in the order of the report.
#pragma once

#include "verification/record/verdict.h"
#include "verification/strain/strain_options.h"
#include "verification/strain/strain_output.h"

#include <vector>

namespace homespun::verification
{
/// @throws BadInput where a table cannot be read back
std::vector<Verdict> study_verdicts(const StrainOutput &output, const StrainStudyOptions &options);
} // namespace homespun::verification
