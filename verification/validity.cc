// SPDX-License-Identifier: MIT
#include "verification/validity.h"

#include "verification/result_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace homespun::verification
{
const std::vector<std::string> &validity_columns()
{
  static const std::vector<std::string> columns = {"cell",
                                                   "load",
                                                   "reference",
                                                   "measure",
                                                   "limit",
                                                   "relation",
                                                   "largest_strain",
                                                   "largest_strain_lower",
                                                   "largest_strain_upper",
                                                   "note"};
  return columns;
}

Crossing crossing(const std::vector<double> &strains, const std::vector<double> &errors,
                  const double limit)
{
  const auto log_of = [](const double x)
  { return std::log(std::max(x, std::numeric_limits<double>::min())); };
  if (strains.empty() || errors.front() > limit)
    return {'-', strains.empty() ? 0. : strains.front()};
  for (std::size_t k = 1; k < strains.size(); ++k)
    if (errors[k] > limit)
    {
      const double from = log_of(errors[k - 1]), to = log_of(errors[k]);
      const double part = (log_of(limit) - from) / (to - from);
      return {'=', strains[k - 1] * std::pow(strains[k] / strains[k - 1], part)};
    }
  return {'>', strains.back()};
}

namespace
{
std::string percent(const double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g %%", 100. * value);
  return text;
}

struct Level
{
  double strain, error, bar; ///< in the unit of the measure
};

std::vector<std::string> row_of(const std::array<std::string, 3> &keys, const std::string &measure,
                                const double limit, const std::vector<Level> &levels)
{
  std::vector<double> strains, errors, with_bar, without_bar;
  for (const Level &level : levels)
  {
    const double bar = std::isfinite(level.bar) ? level.bar : 0.;
    strains.push_back(level.strain);
    errors.push_back(level.error);
    with_bar.push_back(level.error + bar);
    without_bar.push_back(std::max(0., level.error - bar));
  }
  const Crossing best = crossing(strains, errors, limit);
  // The bars' own ends: nothing below the ladder, its end where the limit is kept throughout.
  const Crossing low  = crossing(strains, with_bar, limit),
                 high = crossing(strains, without_bar, limit);
  std::string note;
  if (best.relation == '-')
    note = "at strain " + csv_number(strains.front()) + " the error is already " +
           percent(errors.front()) + " of the " + measure;
  else if (low.relation == '-')
    note =
      "not resolved: with the reference's error bar the limit is exceeded at the smallest strain";
  else if (best.relation == '=' && high.relation == '>')
    note = "upper end open: without the error bar the limit is kept at every level";
  if (std::any_of(levels.begin(), levels.end(),
                  [](const Level &level) { return !std::isfinite(level.bar); }))
    note += std::string(note.empty() ? "" : "; ") + "error bar of the reference not known";
  const auto shown = [](const Crossing &one)
  { return one.relation == '-' ? std::string() : csv_number(one.strain); };
  return {
    keys[0],     keys[1],    keys[2],     measure, csv_number(limit), std::string(1, best.relation),
    shown(best), shown(low), shown(high), note};
}
} // namespace

std::vector<std::vector<std::string>>
validity_rows(const std::vector<std::vector<std::string>> &strain_rows)
{
  std::vector<std::array<std::string, 3>> cases;
  for (const std::vector<std::string> &row : strain_rows)
    if (const std::array<std::string, 3> one = {row[0], row[1], row[3]};
        row[4] == "localized" && std::find(cases.begin(), cases.end(), one) == cases.end())
      cases.push_back(one);
  std::vector<std::vector<std::string>> rows;
  for (const std::array<std::string, 3> &keys : cases)
  {
    std::vector<std::vector<std::string>> of_case;
    double first_unreached = std::numeric_limits<double>::infinity();
    for (const std::vector<std::string> &row : strain_rows)
      if (row[0] == keys[0] && row[1] == keys[1] && row[3] == keys[2])
      {
        if (row[4] == "unreached")
          first_unreached = std::min(first_unreached, csv_value(row[2]));
        else if (row[4] == "localized" && std::isfinite(csv_value(row[8])))
          of_case.push_back(row);
      }
    std::sort(of_case.begin(), of_case.end(),
              [](const auto &a, const auto &b) { return csv_value(a[2]) < csv_value(b[2]); });
    // error_mean_m 8, per cell 11, per fluctuation 12, reference_uncertainty_m 13
    for (const auto &[measure, column, limits] :
         {std::make_tuple(std::string("fluctuation"), 12, std::vector<double>{0.01, 0.05, 0.1}),
          std::make_tuple(std::string("cell side"), 11, std::vector<double>{0.01, 0.05})})
    {
      std::vector<Level> levels;
      for (const std::vector<std::string> &row : of_case)
        if (const double error = csv_value(row[static_cast<std::size_t>(column)]);
            std::isfinite(error) && csv_value(row[2]) < first_unreached)
        {
          // The bar in m has the unit of the measure by the row's own ratio.
          const double in_metres = csv_value(row[8]);
          levels.push_back({csv_value(row[2]), error,
                            in_metres > 0. ? csv_value(row[13]) * error / in_metres : 0.});
        }
      if (levels.empty())
        continue; // a sheet whose reference does not fluctuate has no such measure
      for (const double limit : limits)
      {
        std::vector<std::string> row = row_of(keys, measure, limit, levels);
        if (row[5] == ">" && std::isfinite(first_unreached))
          row[9] += std::string(row[9].empty() ? "" : "; ") +
                    "no equilibrium of reference or coarse cloth was found at strain " +
                    csv_number(first_unreached);
        rows.push_back(row);
      }
    }
  }
  return rows;
}
} // namespace homespun::verification
