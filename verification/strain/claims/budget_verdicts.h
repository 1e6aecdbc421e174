// SPDX-License-Identifier: MIT
// The claims of an error budget, judged from its rows and those of the errors that it splits.
#pragma once

#include "verification/record/verdict.h"
#include "verification/strain/budget/budget_rows.h"
#include "verification/strain/budget/budget_tables.h"
#include "verification/strain/strain_tables.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Judges, for every cell and load among the rows of strain.csv and at the levels nearest to 1 %
/// and 10 %:
/// - what the parts leave of the error, within the bar of their sum; INCONCLUSIVE where that bar is
///   above a fifth of the error, the reference was not reached or a part not found; where the total
///   is zero to what the solvers leave, whether the sum is as well
/// - the error bar of the reference covers its distance from P2 on the same mesh
/// - part 7 at most 1 % of the total
/// and over the levels up to 2 %, where the study has three of them: the mean of part 2 grows as
/// strain squared, slope 2 +- 0.1, or is zero to what the solvers leave at each.
/// @param strains that the study was asked for: what they cannot decide is no claim
/// @param levels of which some may lie beyond the loss of the law: what does not hold there is open
std::vector<Verdict> budget_verdicts(const std::vector<StrainRow> &strain_rows,
                                     const std::vector<BudgetRow> &budget_rows,
                                     const std::vector<double> &strains,
                                     const std::vector<LevelRow> &levels = {});

/// Judges at the same levels whether strain.csv has of `localized` the error that the budget
/// splits: two ways from the same positions to one number.
std::vector<Verdict> error_agreement_verdicts(const std::vector<StrainRow> &strain_rows,
                                              const std::vector<BudgetRow> &budget_rows);

/// Judges each row of a second code: two codes that solve one discrete problem agree.
/// @param levels as of budget_verdicts()
std::vector<Verdict> second_code_verdicts(const std::vector<CrossCheckRow> &rows,
                                          const std::vector<LevelRow> &levels = {});

/// At the judged levels: parts that are larger than the error and cancel, and how far the
/// homogenized sheet that counts as resolved is so. Ready sentences.
std::vector<std::string> budget_notes(const std::vector<StrainRow> &strain_rows,
                                      const std::vector<BudgetRow> &budget_rows);
} // namespace homespun::verification
