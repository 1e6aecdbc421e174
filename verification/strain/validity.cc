// SPDX-License-Identifier: MIT
#include "verification/strain/validity.h"

#include "verification/method/method.h"
#include "verification/record/number_text.h"
#include "verification/strain/gains.h"
#include "verification/strain/strain_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
double strain_of_loss(const std::vector<LevelRow> &rows)
{
  std::vector<LevelRow> sorted = rows;
  std::sort(sorted.begin(), sorted.end(),
            [](const LevelRow &a, const LevelRow &b) { return a.strain < b.strain; });
  double strain = 0., least = 1.;
  for (const LevelRow &row : sorted)
  {
    if (row.lost > 0)
      return strain + (row.strain - strain) * least / (least - row.least);
    strain = row.strain;
    least  = row.least;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double elliptic_up_to(const std::vector<LevelRow> &all, const std::string &cell,
                      const std::string &load, const std::string &reference)
{
  std::vector<std::string> parts;
  for (const LevelRow &row : all)
    if (std::find(parts.begin(), parts.end(), row.part) == parts.end())
      parts.push_back(row.part);
  double first = std::numeric_limits<double>::quiet_NaN();
  for (const std::string &part : parts)
  {
    std::vector<LevelRow> rows;
    for (const LevelRow &row : all)
      if (row.cell == cell && row.load == load && row.reference == reference && row.part == part)
        rows.push_back(row);
    first = std::fmin(first, strain_of_loss(rows));
  }
  return first;
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
struct Level
{
  double strain, error, bar; ///< in the unit of the measure
};

/// Beyond the first loss of ellipticity what is compared is one equilibrium of its mesh, and a
/// small error says nothing: the range ends there.
/// @param smallest strain of the ladder
void end_at_loss(ValidityRow &row, const double smallest)
{
  if (!std::isfinite(row.elliptic_up_to))
    return;
  if (row.upper > row.elliptic_up_to)
    row.upper = row.elliptic_up_to;
  if (!(row.elliptic_up_to < row.largest))
    return;
  if (row.elliptic_up_to < smallest)
  {
    row.relation = "?";
    row.largest = row.lower = row.upper = ValidityRow::none;
    row.note = row.reference + " loses ellipticity at " + percent_text(row.elliptic_up_to) +
               ", before the smallest strain of the study";
    return;
  }
  row.note +=
    std::string(row.note.empty() ? "" : "; ") + "the range ends where " + row.reference +
    " loses ellipticity in reference or coarse cloth; the error alone would keep the limit " +
    (row.relation == ">" ? "at every level, to " : "to ") + percent_text(row.largest);
  row.relation = "=";
  for (double *const strain : {&row.largest, &row.lower})
    if (*strain > row.elliptic_up_to) // what is not known stays so
      *strain = row.elliptic_up_to;
}

/// The rows, and as those of `base` the ones that are the base of the method that their case speaks
/// of.
std::vector<StrainRow> with_bases(const std::vector<StrainRow> &rows)
{
  std::vector<StrainRow> all = rows, without;
  for (const StrainRow &row : rows)
    if (row.is_reached() && row.method == main_method(rows, row))
    {
      const StrainRow *const base = base_of(rows, row);
      std::vector<StrainRow> &to  = base != nullptr ? all : without;
      to.push_back(base != nullptr ? *base : row);
      to.back().method = base_method;
    }
  // A level at which no base has an equilibrium ends the range of one that has it elsewhere.
  for (StrainRow &row : without)
    if (std::any_of(all.begin(), all.end(),
                    [&](const StrainRow &other)
                    { return is_of_case(other, row) && other.method == base_method; }))
    {
      row.mean = StrainRow::none;
      all.push_back(row);
    }
  return all;
}

/// Of loads that no judged method came to at any level, one row for each method that is judged
/// under another load.
std::vector<StrainRow> without_any_level(const std::vector<StrainRow> &rows,
                                         const std::vector<StrainRow> &cases)
{
  std::vector<StrainRow> missing;
  const auto is_in = [](const std::vector<StrainRow> &some, const StrainRow &row)
  {
    return std::any_of(some.begin(), some.end(),
                       [&](const StrainRow &one) { return is_of_case(one, row); });
  };
  for (const StrainRow &row : rows)
  {
    if (row.is_reached() || is_in(cases, row) || is_in(missing, row))
      continue;
    std::vector<std::string> methods;
    for (const StrainRow &one : cases)
      if (one.cell == row.cell && one.reference == row.reference &&
          std::find(methods.begin(), methods.end(), one.method) == methods.end())
        methods.push_back(one.method);
    if (methods.empty())
      methods.emplace_back("localized");
    for (const std::string &method : methods)
    {
      missing.push_back(row);
      missing.back().method = method;
    }
  }
  return missing;
}

/// A row without a range: nothing is known.
ValidityRow row_of(const StrainRow &one, const std::string &measure, const double limit)
{
  ValidityRow row;
  row.cell      = one.cell;
  row.load      = one.load;
  row.reference = one.reference;
  row.method    = one.method;
  row.measure   = measure;
  row.limit     = limit;
  row.relation  = "?";
  return row;
}

ValidityRow row_of(const StrainRow &one, const std::string &measure, const double limit,
                   const std::vector<Level> &levels)
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
    note = "at strain " + short_text(strains.front()) + " the error is already " +
           percent_text(errors.front()) + " of the " + measure;
  else if (low.relation == '-')
    note = "not resolved: with its error bar the error exceeds the limit at the smallest strain";
  else if (best.relation == '=' && high.relation == '>')
    note = "upper end open: without the error bar the limit is kept at every level";
  if (std::any_of(levels.begin(), levels.end(),
                  [](const Level &level) { return !std::isfinite(level.bar); }))
    note += std::string(note.empty() ? "" : "; ") + "the error bar is not known at every level";
  const auto shown = [](const Crossing &crossed)
  { return crossed.relation == '-' ? ValidityRow::none : crossed.strain; };
  ValidityRow row = row_of(one, measure, limit);
  row.relation    = std::string(1, best.relation);
  row.largest     = shown(best);
  row.lower       = shown(low);
  row.upper       = shown(high);
  row.note        = note;
  return row;
}
} // namespace

std::vector<ValidityRow> validity_rows(const std::vector<StrainRow> &given,
                                       const std::vector<LevelRow> &levels,
                                       const std::map<std::string, double> &least_radius_of_cell)
{
  const std::vector<StrainRow> all = with_bases(given);
  const auto is_judged             = [&](const StrainRow &row)
  {
    return row.method == "localized" || row.method == base_method ||
           row.method == main_method(given, row);
  };
  std::vector<StrainRow> cases; // and their methods
  for (const StrainRow &row : all)
    if (is_judged(row) &&
        std::none_of(cases.begin(), cases.end(),
                     [&](const StrainRow &known)
                     { return is_of_case(known, row) && known.method == row.method; }))
      cases.push_back(row);
  for (const StrainRow &one : without_any_level(given, cases))
    cases.push_back(one);
  struct Measure
  {
    const char *name;
    double StrainRow::*error;
    std::vector<double> limits;
  };
  const std::vector<Measure> measures = {
    {"fluctuation", &StrainRow::per_fluctuation, {0.01, 0.05, 0.1}},
    {"cell side", &StrainRow::per_cell, {0.01, 0.05}}};
  std::vector<ValidityRow> rows;
  for (const StrainRow &one : cases)
  {
    std::vector<StrainRow> of_case;
    double first_unreached = std::numeric_limits<double>::infinity();
    for (const StrainRow &row : all)
      if (is_of_case(row, one))
      {
        const bool is_its = row.method == one.method;
        if (!row.is_reached() || (is_its && !std::isfinite(row.mean)))
          first_unreached = std::min(first_unreached, row.strain);
        else if (is_its)
          of_case.push_back(row);
      }
    std::sort(of_case.begin(), of_case.end(),
              [](const StrainRow &a, const StrainRow &b) { return a.strain < b.strain; });
    const double up_to = elliptic_up_to(levels, one.cell, one.load, one.reference);
    for (const Measure &measure : measures)
    {
      std::vector<Level> levels;
      for (const StrainRow &row : of_case)
        if (const double error = row.*(measure.error);
            std::isfinite(error) && row.strain < first_unreached)
          // The bar in m has the unit of the measure by the row's own ratio.
          levels.push_back({row.strain, error, row.mean > 0. ? row.bar * error / row.mean : 0.});
      const bool has_measure =
        std::any_of(of_case.begin(), of_case.end(),
                    [&](const StrainRow &row) { return std::isfinite(row.*(measure.error)); });
      if (levels.empty() && !of_case.empty() && !has_measure)
        continue; // a sheet whose reference does not fluctuate has no such measure
      for (const double limit : measure.limits)
      {
        ValidityRow row = levels.empty() ? row_of(one, measure.name, limit)
                                         : row_of(one, measure.name, limit, levels);
        if ((row.relation == ">" || row.relation == "?") && std::isfinite(first_unreached))
          row.note += std::string(row.note.empty() ? "" : "; ") +
                      "no equilibrium of reference or coarse cloth was found at strain " +
                      short_text(first_unreached);
        row.elliptic_up_to = up_to;
        if (const auto known = least_radius_of_cell.find(row.cell);
            known != least_radius_of_cell.end())
          row.least_radius = known->second;
        end_at_loss(row, levels.empty() ? 0. : levels.front().strain);
        rows.push_back(row);
      }
    }
  }
  return rows;
}
} // namespace homespun::verification
