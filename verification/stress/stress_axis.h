// SPDX-License-Identifier: MIT
// One axis of the stability map as data: what is made harder, along which ladder of values, when an
// answer is right, and where theory sees the end. Climbing never throws: a refusal ends the axis.
#pragma once

#include "verification/record/verdict.h"
#include "verification/stress/stress_tables.h"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What one value gave.
struct StressAnswer
{
  double error = 0.;      ///< compared with the limit of the axis
  Eigen::MatrixXd values; ///< all numbers that a user would get; every one must be finite
  std::string wrong                  = {}; ///< what is wrong, where it has several ways to be
  std::optional<unsigned> iterations = {};
  std::optional<unsigned long> dofs  = {};
};

/// What theory says of the end of an axis.
enum class TheoryOfEnd
{
  none,
  estimates, ///< about where round-off ends it
  promises   ///< that it does not end before: a claim
};

struct StressAxis
{
  std::string axis, of, value_is, criterion;
  bool is_shipped = true;     ///< what it is of: limits are published of nothing else
  double limit    = 0.;       ///< of the error, written before any value is run
  std::vector<double> ladder; ///< from harmless to hard
  std::function<StressAnswer(double value)>
    at; ///< throws BadInput, NotConverged, which end the axis
  TheoryOfEnd theory    = TheoryOfEnd::none;
  double theory_end     = 0.;
  std::string theory_is = {};
  double most = std::numeric_limits<double>::infinity(); ///< the largest value that is tried
  std::string why_most = {};
};

/// Climbs the ladder until an answer is not right, and repeats the last that was, whose numbers
/// must be the same to the last bit.
/// @param longest a value that takes longer is the last [s]
/// @param told every rung
LimitRow climb(const StressAxis &axis, double longest,
               const std::function<void(const StressRow &)> &told);

/// The claim that no value is wrong up to the published limit, and to where theory promises it;
/// nothing where neither is there.
/// @param published null: none
std::optional<Verdict> verdict_of(const StressAxis &axis, const LimitRow &found,
                                  const PublishedLimitRow *published);
} // namespace homespun::verification
