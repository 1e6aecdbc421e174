// SPDX-License-Identifier: MIT
// The claims of a strain study, judged from its rows.
#pragma once

#include "verification/verdict.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Least-squares slope of log y against log x, for positive values.
double log_slope(const std::vector<double> &x, const std::vector<double> &y);

/// Judges, for every cell among the rows of strain.csv:
/// - periodic loads, reference biot: the localized error falls as strain squared, slope 2 +- 0.1 over
///   the levels from 1e-4 to 0.1; or is zero to round-off (below 1e-10 strain x cell side) at each; or as strain squared or
///   faster at the three smallest levels, where their two slopes agree; INCONCLUSIVE with fewer than three levels, or where
///   these slopes differ
/// - sheet loads, reference biot, at the level nearest to 1 %: localized is closer to the reference
///   than affine, by more than the reference's error bar; INCONCLUSIVE within the bar
std::vector<Verdict> strain_verdicts(const std::vector<std::vector<std::string>> &rows);
} // namespace homespun::verification
