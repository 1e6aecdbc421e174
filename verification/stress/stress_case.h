// SPDX-License-Identifier: MIT
// A stress case as data: the row of its table, what is done, the one figure that is measured and
// its limit. Running never throws: a failure is a row, not the end of the program.
#pragma once

#include "verification/record/verdict.h"
#include "verification/stress/stress_tables.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What one repetition found.
struct StressAnswer
{
  double figure = 0.;     ///< compared with the case's limit
  Eigen::MatrixXd values; ///< all numbers that a user would get; every one must be finite
};

/// What the figure of a case may be.
struct Limit
{
  double value = 0.;
  std::string is;         ///< what the figure is, with its unit
  std::string derivation; ///< where the limit comes from, known before the figure
};

/// How often a case is looked at.
enum class Repeats
{
  with_seeds, ///< seeds differ, and so may the numbers
  same_bits,  ///< every repetition must give the same numbers to the last bit
  twice,      ///< the same, for what is long
  once        ///< for what is longer
};

struct StressCase
{
  using Run = std::function<StressAnswer(unsigned int seed)>;

  /// @param expected in words
  /// @param run throws BadInput, NotConverged, which are failures
  /// @throws std::logic_error where the limit has no derivation
  StressCase(const std::string &group, const std::string &name, const std::string &expected,
             const Limit &limit, Repeats repeats, Run run);

  StressRow row; ///< without what a run finds
  double limit;
  Repeats repeats;
  Run run;
};

/// The row of a case that was run with the seeds 0 ... repeats − 1, or fewer where it wants no
/// more. The figure is the largest of all repetitions, not-a-number where there is none; the
/// outcome is finite, finite but ..., not finite, refused: message, or error: message.
StressRow run_case(const StressCase &stress_case, int repeats);

/// One verdict per group, in the order of the rows: how many of its cases do not hold.
std::vector<Verdict> stress_verdicts(const std::vector<StressRow> &rows);
} // namespace homespun::verification
