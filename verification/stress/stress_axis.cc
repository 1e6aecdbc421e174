// SPDX-License-Identifier: MIT
#include "verification/stress/stress_axis.h"

#include "meshes/plain/errors.h"
#include "verification/record/claim.h"
#include "verification/record/number_text.h"
#include "verification/record/timing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homespun::verification
{
namespace
{
/// No more than a reader takes in: the beginning, and where residuals are told the last of them.
std::string cut(std::string text)
{
  constexpr std::size_t beginning = 260, end = 80;
  if (text.size() > beginning + end)
    text = text.substr(0, beginning) + " ... " + text.substr(text.size() - end);
  return text;
}

/// What one value came to.
struct Rung
{
  StressAnswer answer;
  std::string ended_by; ///< empty: it is right
  std::string why;
};

Rung rung_at(const StressAxis &axis, const double value)
{
  Rung rung;
  rung.answer.error = std::numeric_limits<double>::quiet_NaN();
  try
  {
    rung.answer = axis.at(value);
    if (!rung.answer.wrong.empty())
      rung.why = rung.answer.wrong;
    else if (!std::isfinite(rung.answer.error) || !rung.answer.values.allFinite())
      rung.why = "the answer is not finite";
    else if (!(rung.answer.error <= axis.limit))
      rung.why = "error " + short_text(rung.answer.error) + " above " + short_text(axis.limit);
    rung.ended_by = rung.why.empty() ? "" : "error";
  }
  catch (const std::exception &refusal)
  {
    rung.ended_by = "solver";
    rung.why      = cut(refusal.what());
  }
  return rung;
}

StressRow row_of(const StressAxis &axis, const double value, const Rung &rung, const double seconds)
{
  StressRow row;
  row.axis       = axis.axis;
  row.of         = axis.of;
  row.value      = value;
  row.error      = rung.answer.error;
  row.limit      = axis.limit;
  row.outcome    = rung.ended_by.empty() ? "right" : rung.why;
  row.iterations = rung.answer.iterations;
  row.dofs       = rung.answer.dofs;
  row.seconds    = seconds;
  return row;
}

/// A ladder of floating-point products: a rung is a published one within its last digits.
bool is_up_to(const double value, const double most)
{
  return value <= most * (1. + 1e-6);
}
} // namespace

LimitRow climb(const StressAxis &axis, const double owed, const double longest,
               const std::function<void(const StressRow &)> &told)
{
  LimitRow row;
  row.axis      = axis.axis;
  row.of        = axis.of;
  row.value_is  = axis.value_is;
  row.limit     = axis.limit;
  row.criterion = axis.criterion;
  if (axis.theory != TheoryOfEnd::none)
    row.theory = axis.theory_end;
  row.theory_is = axis.theory_is;
  row.ended_by  = "ladder";
  row.why       = "no value on the ladder is wrong";
  Eigen::MatrixXd last;
  double last_took = 0.;
  for (const double value : axis.ladder)
  {
    if (value > axis.most || (last_took > longest && !is_up_to(value, owed)))
    {
      row.ended_by = "cap";
      row.why      = value > axis.most ? axis.why_most : "a value more would take too long";
      break;
    }
    Rung rung;
    last_took = seconds_of([&]() { rung = rung_at(axis, value); });
    row.seconds += last_took;
    told(row_of(axis, value, rung, last_took));
    row.error = rung.answer.error;
    if (!rung.ended_by.empty())
    {
      row.end      = value;
      row.ended_by = rung.ended_by;
      row.why      = rung.why;
      break;
    }
    row.reached = value;
    last        = std::move(rung.answer.values);
  }
  if (row.reached && last_took < 0.2 * longest)
  {
    Rung again;
    row.seconds += seconds_of([&]() { again = rung_at(axis, *row.reached); });
    if (!again.ended_by.empty() || again.answer.values.size() != last.size() ||
        again.answer.values != last)
    {
      row.end      = row.reached;
      row.reached  = {};
      row.ended_by = "repetition";
      row.why      = "the same again gave other numbers";
    }
  }
  return row;
}

OwedValue owed_value(const StressAxis &axis, const PublishedLimitRow *published)
{
  OwedValue owed;
  if (axis.theory == TheoryOfEnd::promises)
    owed = {axis.theory_end, "theory: " + axis.theory_is};
  if (published && published->reached.value_or(0.) > owed.value)
    owed = {*published->reached, "published/limits.csv, of revision " + published->revision};
  return owed;
}

std::optional<Verdict> verdict_of(const StressAxis &axis, const LimitRow &found,
                                  const OwedValue &owed)
{
  if (owed.why.empty())
    return {};
  // What a size leaves out is not asked.
  double asked = 0.;
  for (const double value : axis.ladder)
    if (is_up_to(value, owed.value) && value <= axis.most)
      asked = std::max(asked, value);
  const bool falls = found.end && is_up_to(*found.end, owed.value),
             holds = found.end || is_up_to(asked, found.reached.value_or(0.));
  return judged("stress-limit",
                {{"axis", axis.axis}, {"of", axis.of}, {"largest", asked}, {"why", owed.why}},
                falls   ? Outcome::fail
                : holds ? Outcome::pass
                        : Outcome::inconclusive,
                falls ? 1. : 0.);
}
} // namespace homespun::verification
