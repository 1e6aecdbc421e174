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

/// Up to which value an axis must not end, and who says so; 0 where nobody does.
struct OwedValue
{
  double value    = 0.;
  std::string why = {};
};

/// The published limit, or that which theory promises, the larger of them.
/// @param published null: none
OwedValue owed_value(const StressAxis &axis, const PublishedLimitRow *published);

/// Climbs the ladder until an answer is not right, and repeats the last that was, unless it
/// took long: its numbers must be the same to the last bit.
/// @param owed values up to it are tried however long they take
/// @param longest beyond that, a value that takes longer ends the climb [s]
/// @param told every rung
LimitRow climb(const StressAxis &axis, double owed, double longest,
               const std::function<void(const StressRow &)> &told);

/// The claim that no value is wrong up to what is owed; nothing where nothing is.
std::optional<Verdict> verdict_of(const StressAxis &axis, const LimitRow &found,
                                  const OwedValue &owed);
} // namespace homespun::verification
