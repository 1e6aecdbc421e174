// SPDX-License-Identifier: MIT
#include "verification/converge/converge_record.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
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
{
  std::set<std::array<std::string, 3>> complete;
  for (const ConvergeRow &row : of_kind(ConvergeRow::case_kind))
    complete.insert({row.cell, row.study, row.name});
  rows.keep(
    [&](const ConvergeRow &row) {
      return complete.count({row.cell, row.study, row.name}) != 0;
    });
}

bool ConvergenceRecord::is_complete(const ConvergenceCase &one) const
{
  return rows.contains({one.cell, one.study, one.name, ConvergeRow::case_kind});
}

void ConvergenceRecord::add(const ConvergenceCase &one, const ConvergenceResult &result,
                            const double seconds)
{
  for (const Series &series : result.series)
    for (std::size_t k = 0; k < series.levels.size(); ++k)
    {
      const ConvergenceLevel &level = series.levels[k];
      ConvergeRow row               = {one.cell, one.study, one.name};
      row.quantity                  = series.quantity;
      row.order_p                   = series.order;
      row.level                     = k;
      row.h                         = level.h;
      row.h_unit                    = series.h_unit;
      row.dofs                      = level.n_dofs;
      row.value                     = level.value.value_or(none);
      row.error                     = level.error.value_or(none);
      row.seconds                   = level.seconds;
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
  for (std::size_t k = 0; k < result.verdicts.size(); ++k)
  {
    const Verdict &verdict = result.verdicts[k];
    ConvergeRow row        = {one.cell, one.study, one.name, ConvergeRow::claim_kind};
    row.level              = k;
    row.claim              = verdict.claim;
    row.id                 = verdict.id;
    row.judgement          = verdict.outcome;
    row.value              = verdict.value;
    row.limit              = verdict.limit;
    row.kind_of_claim      = verdict.kind;
    row.derivation         = verdict.derivation;
    rows.append(row);
  }
  // Last: where it is there, so is all that belongs to it.
  if (!result.unfinished.empty())
    return;
  ConvergeRow complete = {one.cell, one.study, one.name, ConvergeRow::case_kind};
  complete.seconds     = seconds;
  rows.append(complete);
}

std::vector<ConvergeRow> ConvergenceRecord::of_kind(const std::string &kind) const
{
  std::vector<ConvergeRow> found;
  for (const ConvergeRow &row : rows.rows())
    if (row.kind == kind)
      found.push_back(row);
  return found;
}

std::vector<ConvergeRow> ConvergenceRecord::levels() const
{
  return of_kind(ConvergeRow::level_kind);
}

std::vector<Verdict> ConvergenceRecord::verdicts() const
{
  std::vector<Verdict> result;
  for (const ConvergeRow &row : of_kind(ConvergeRow::claim_kind))
    result.push_back({row.cell + ", " + row.study + ", " + row.name + ": " + row.claim,
                      row.judgement.value_or(Outcome::inconclusive),
                      row.value,
                      row.limit,
                      row.derivation,
                      row.kind_of_claim.value_or(Kind::program),
                      row.id,
                      {{"cell", row.cell}, {"study", row.study}, {"case", row.name}}});
  return result;
}
} // namespace homespun::verification
