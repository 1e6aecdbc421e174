// SPDX-License-Identifier: MIT
#include "verification/strain/claims/table_verdicts.h"

#include "verification/law/laws.h"
#include "verification/record/claim.h"
#include "verification/reference/loads.h"
#include "verification/strain/claims/strain_verdicts.h"
#include "verification/strain/gains.h"
#include "verification/strain/strain_cases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace homespun::verification
{
namespace
{
/// Rounding of sums over a million vertices.
constexpr double rounding = 1e-12;

/// The first row of every case in linear theory on a sheet.
template <typename Row>
std::vector<Row> linear_sheets_of(const std::vector<Row> &rows)
{
  std::vector<Row> all = cases_of(rows);
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const Row &row) {
                             return row.reference != name_of(Law::linear) ||
                                    Load(row.load).is_periodic();
                           }),
            all.end());
  return all;
}
} // namespace

Verdict verdict_of_norms(const std::vector<StrainRow> &rows)
{
  int n_wrong = 0, n_rows = 0;
  for (const StrainRow &row : rows)
    if (std::isfinite(row.mean))
    {
      ++n_rows;
      n_wrong += !(row.mean <= (1. + rounding) * row.rms && row.rms <= (1. + rounding) * row.max);
    }
  return open_without(n_rows, at_most("norms", {{"rows", n_rows}}, n_wrong, 0.));
}

Verdict verdict_of_bases(const std::vector<GainRow> &gains, const std::vector<StrainRow> &rows)
{
  int n_wrong = 0;
  for (const GainRow &gain : gains)
  {
    const StrainRow of = {gain.cell, gain.load, gain.strain, gain.reference, gain.method};
    double of_base = GainRow::none, least = GainRow::none;
    for (const StrainRow &row : rows)
      if (may_be_base(row, of))
      {
        least = std::fmin(least, row.mean);
        if (row.method == gain.base)
          of_base = row.mean;
      }
    n_wrong += !(of_base <= least);
  }
  return at_most("best-base", {{"rows", gains.size()}}, n_wrong, 0.);
}

std::vector<Verdict> verdicts_of_nested_forces(const std::vector<UncertaintyRow> &rows)
{
  std::vector<Verdict> verdicts;
  for (const auto &of_case : linear_sheets_of(rows))
  {
    double least = std::numeric_limits<double>::infinity(), most = 0.;
    for (const UncertaintyRow &row : rows)
      if (is_of_case(row, of_case) && std::isfinite(row.force_p1_to_refined))
      {
        least = std::min({least, row.force_p1_to_p2, row.force_p2_to_refined});
        most =
          larger(most, larger(std::abs(row.force_p1_to_p2), std::abs(row.force_p1_to_refined)));
      }
    if (most <= solved_to)
      continue; // nothing was measured, or P1 is exact
    verdicts.push_back(judged(
      "nested-forces", {{"cell", of_case.cell}, {"load", of_case.load}, {"least", solved_to}},
      least > solved_to ? Outcome::pass : Outcome::fail, least));
  }
  return verdicts;
}

std::vector<Verdict> verdicts_of_forces(const std::vector<ForceRow> &rows)
{
  std::vector<Verdict> verdicts;
  for (const auto &of_case : linear_sheets_of(rows))
  {
    std::map<double, std::pair<double, double>> of_strain; // resolved, affine
    for (const ForceRow &row : rows)
      if (is_of_case(row, of_case))
      {
        if (row.method == "resolved")
          of_strain[row.strain].first = row.per_width;
        if (row.method == "affine")
          of_strain[row.strain].second = row.per_width;
      }
    double worst  = 0.5; // of the ratios the one that is farthest from the middle of 0 and 1
    bool is_known = false;
    for (const auto &[strain, forces] : of_strain)
      if (std::isfinite(forces.first) && std::isfinite(forces.second) && forces.second != 0.)
      {
        const double ratio = forces.first / forces.second;
        if (!is_known || std::abs(ratio - 0.5) > std::abs(worst - 0.5))
          worst = ratio;
        is_known = true;
      }
    if (is_known)
      verdicts.push_back(
        judged("force-of-reference", {{"cell", of_case.cell}, {"load", of_case.load}},
               worst > 0. && worst <= 1. + 10. * solved_to ? Outcome::pass : Outcome::fail, worst));
  }
  return verdicts;
}

Verdict verdict_of_reading(const std::vector<StrainRow> &rows, const std::string &folder)
{
  return at_most("read-back", {{"rows", rows.size()}}, n_rows_read_otherwise(rows, folder), 0.);
}
} // namespace homespun::verification
