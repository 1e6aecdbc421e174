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

/// The claim by the three smallest levels of at least three. Where the slopes between them differ by more than the limit of the
/// claim it is open; but not where they fall towards one as those of a first order beside a second do.
/// @param strains ascending
Verdict verdict_of_smallest(const std::string &claim, const std::vector<double> &strains,
                            const std::vector<double> &errors);

/// Judges, for every cell among the rows of strain.csv:
/// - periodic loads, reference biot: the localized error falls as strain squared, slope 2 +- 0.1 over
///   the levels from 1e-4 to 0.1; or is zero to round-off (below 1e-10 strain x cell side) at each; or as strain squared or
///   faster at the three smallest levels, where their two slopes agree (verdict_of_smallest()); FAIL where an error is not a
///   number; INCONCLUSIVE with fewer than three levels
/// - sheet loads, reference biot, at the level nearest to 1 %: localized is closer to the reference
///   than affine, by more than the reference's error bar; INCONCLUSIVE within the bar
std::vector<Verdict> strain_verdicts(const std::vector<std::vector<std::string>> &rows);
} // namespace homespun::verification
