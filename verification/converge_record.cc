// SPDX-License-Identifier: MIT
#include "verification/converge_record.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string field(std::string text)
{
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

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

void ConvergenceResult::add(Series one, const std::string &claim)
{
  if (!claim.empty() && one.judgement)
    verdicts.push_back({claim + " (order)", one.judgement->outcome, one.judgement->order,
                        one.judgement->limit + "; found: " + one.judgement->why});
  series.push_back(std::move(one));
}

const std::vector<std::string> &converge_columns()
{
  static const std::vector<std::string> columns = {"cell",
                                                   "study",
                                                   "case",
                                                   "quantity",
                                                   "order_p",
                                                   "level",
                                                   "h",
                                                   "h_unit",
                                                   "dofs",
                                                   "value",
                                                   "error",
                                                   "observed_order",
                                                   "order",
                                                   "spread",
                                                   "order_lowest",
                                                   "order_highest",
                                                   "richardson_limit",
                                                   "gci",
                                                   "judgement",
                                                   "seconds"};
  return columns;
}

ConvergenceRecord::ConvergenceRecord(const std::string &folder, const bool resume)
    : rows(folder + "/converge.csv", converge_columns(), 6, resume)
    , claims(folder + "/claims.csv",
             {"cell", "study", "case", "claim", "verdict", "value", "limit"}, 4, resume)
    , cases(folder + "/cases.csv", {"cell", "study", "case", "seconds"}, 3, resume)
{
  const auto is_of_complete_case = [this](const std::vector<std::string> &row) {
    return cases.contains({row[0], row[1], row[2]});
  };
  rows.keep(is_of_complete_case);
  claims.keep(is_of_complete_case);
}

bool ConvergenceRecord::is_complete(const ConvergenceCase &one) const
{
  return cases.contains({one.cell, one.study, field(one.name)});
}

void ConvergenceRecord::add(const ConvergenceCase &one, const ConvergenceResult &result,
                            const double seconds)
{
  const std::string name = field(one.name);
  for (const Series &series : result.series)
    for (std::size_t k = 0; k < series.levels.size(); ++k)
    {
      const ConvergenceLevel &level       = series.levels[k];
      const std::vector<std::string> keys = {
        one.cell,         one.study, name, field(series.quantity), std::to_string(series.order),
        std::to_string(k)};
      if (rows.contains(keys))
        continue;
      const bool judged            = series.judgement.has_value();
      std::vector<std::string> row = keys;
      for (const std::string &text :
           {csv_number(level.h), series.h_unit, std::to_string(level.n_dofs),
            csv_number(level.value.value_or(none)), csv_number(level.error.value_or(none)),
            csv_number(judged ? series.judgement->observed[k] : none),
            csv_number(judged ? series.judgement->order : none),
            csv_number(judged ? series.judgement->spread : none),
            csv_number(judged ? series.judgement->limits.lowest : none),
            csv_number(judged ? series.judgement->limits.highest : none),
            csv_number(series.richardson ? series.richardson->limit : none),
            csv_number(series.richardson ? series.richardson->gci : none),
            judged ? name_of(series.judgement->outcome) : std::string(), csv_number(level.seconds)})
        row.push_back(text);
      rows.append(row);
    }
  for (const Verdict &verdict : result.verdicts)
  {
    const std::vector<std::string> keys = {one.cell, one.study, name, field(verdict.claim)};
    if (claims.contains(keys))
      continue;
    std::vector<std::string> row = keys;
    for (const std::string &text :
         {name_of(verdict.outcome), csv_number(verdict.value), field(verdict.limit)})
      row.push_back(text);
    claims.append(row);
  }
  // Last: where it is there, so is all that belongs to it.
  if (result.unfinished.empty())
    cases.append({one.cell, one.study, name, csv_number(seconds)});
}

std::vector<Verdict> ConvergenceRecord::verdicts() const
{
  std::vector<Verdict> result;
  for (const std::vector<std::string> &row : claims.rows())
  {
    Verdict verdict;
    verdict.claim   = row[0] + ", " + row[1] + ", " + row[2] + ": " + row[3];
    verdict.outcome = row[4] == "PASS"   ? Outcome::pass
                      : row[4] == "FAIL" ? Outcome::fail
                                         : Outcome::inconclusive;
    verdict.value   = csv_value(row[5]);
    verdict.limit   = row[6];
    result.push_back(verdict);
  }
  return result;
}
} // namespace homespun::verification
