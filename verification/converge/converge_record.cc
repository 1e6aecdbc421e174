// SPDX-License-Identifier: MIT
#include "verification/converge/converge_record.h"

#include <cmath>
#include <limits>
#include <utility>

namespace homespun::verification
{
namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<double> of_levels(const Series &series, double (*function)(const ConvergenceLevel &))
{
  std::vector<double> result;
  for (const ConvergenceLevel &level : series.levels)
    result.push_back(function(level));
  return result;
}
} // namespace

void Series::extrapolate(const double floor, const double highest_order,
                         const OrderJudgement &judged)
{
  Richardson limit = extrapolated(sizes(), values(), floor, highest_order);
  if (!limit.exists)
    return;
  if (judged.outcome == Outcome::inconclusive)
    limit.gci = none;
  richardson = limit;
  for (ConvergenceLevel &level : levels)
    level.error = std::abs(*level.value - limit.limit);
}

bool Series::has_error_bar() const
{
  return richardson && std::isfinite(richardson->gci);
}

std::vector<double> Series::sizes() const
{
  return of_levels(*this, [](const ConvergenceLevel &level) { return level.h; });
}

std::vector<double> Series::values() const
{
  return of_levels(*this, [](const ConvergenceLevel &level) { return level.value.value_or(none); });
}

std::vector<double> Series::errors() const
{
  return of_levels(*this, [](const ConvergenceLevel &level) { return level.error.value_or(none); });
}

void ConvergenceResult::add(Series one)
{
  series.push_back(std::move(one));
}

void ConvergenceResult::add(Series one, const std::string &claim, Words words)
{
  if (one.judgement)
  {
    words["limit"] = one.judgement->limit + "; found: " + one.judgement->why;
    verdicts.push_back(judged(claim, words, one.judgement->outcome, one.judgement->order));
  }
  add(std::move(one));
}

ConvergenceRecord::ConvergenceRecord(const std::string &folder)
    : rows(folder)
    , claims(folder)
    , cases(folder)
{
  const auto is_of_complete_case = [this](const auto &row) {
    return cases.contains({row.cell, row.study, row.name});
  };
  rows.keep(is_of_complete_case);
  claims.keep(is_of_complete_case);
}

bool ConvergenceRecord::is_complete(const ConvergenceCase &one) const
{
  return cases.contains({one.cell, one.study, one.name});
}

void ConvergenceRecord::add(const ConvergenceCase &one, const ConvergenceResult &result,
                            const double seconds)
{
  for (const Series &series : result.series)
    for (std::size_t k = 0; k < series.levels.size(); ++k)
    {
      const ConvergenceLevel &level = series.levels[k];
      ConvergeRow row;
      row.cell     = one.cell;
      row.study    = one.study;
      row.name     = one.name;
      row.quantity = series.quantity;
      row.order_p  = series.order;
      row.level    = k;
      row.h        = level.h;
      row.h_unit   = series.h_unit;
      row.dofs     = level.n_dofs;
      row.value    = level.value.value_or(none);
      row.error    = level.error.value_or(none);
      row.seconds  = level.seconds;
      if (series.judgement)
      {
        row.observed_order = series.judgement->observed[k];
        row.order          = series.judgement->order;
        row.spread         = series.judgement->spread;
        row.order_lowest   = series.judgement->limits.lowest;
        row.order_highest  = series.judgement->limits.highest;
        row.judgement      = series.judgement->outcome;
      }
      if (series.richardson)
      {
        row.richardson_limit = series.richardson->limit;
        row.gci              = series.richardson->gci;
      }
      rows.append_if_missing(row);
    }
  for (const Verdict &verdict : result.verdicts)
    claims.append_if_missing({one.cell, one.study, one.name, verdict.claim, verdict.id,
                              verdict.outcome, verdict.value, verdict.limit, verdict.kind,
                              verdict.derivation});
  // Last: where it is there, so is all that belongs to it.
  if (result.unfinished.empty())
    cases.append({one.cell, one.study, one.name, seconds});
}

std::vector<Verdict> ConvergenceRecord::verdicts() const
{
  std::vector<Verdict> result;
  for (const ClaimRow &row : claims.rows())
    result.push_back({row.cell + ", " + row.study + ", " + row.name + ": " + row.claim,
                      row.verdict,
                      row.value,
                      row.limit,
                      row.derivation,
                      row.kind,
                      row.id,
                      {{"cell", row.cell}, {"study", row.study}, {"case", row.name}}});
  return result;
}
} // namespace homespun::verification
