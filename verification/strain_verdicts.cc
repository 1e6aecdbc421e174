// SPDX-License-Identifier: MIT
#include "verification/strain_verdicts.h"

#include "verification/result_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace homespun::verification
{
namespace
{
/// The columns of strain.csv that are judged.
struct Row
{
  std::string cell, load, reference, method;
  double strain, error_m, error_per_cell, uncertainty_m;
};

std::vector<Row> parsed(const std::vector<std::vector<std::string>> &rows)
{
  std::vector<Row> result;
  for (const std::vector<std::string> &row : rows)
    if (row[4] != "unreached")
      result.push_back({row[0], row[1], row[3], row[4], csv_value(row[2]), csv_value(row[8]),
                        csv_value(row[11]), csv_value(row[13])});
  return result;
}

constexpr double round_off = 1e-10; ///< in strain x cell side

Verdict periodic_verdict(const std::string &cell, const std::string &load,
                         const std::vector<Row> &rows)
{
  std::vector<std::pair<double, double>> levels; // strain and error
  for (const Row &row : rows)
    if (row.cell == cell && row.load == load && row.reference == "biot" &&
        row.method == "localized" && row.strain <= 0.101)
      levels.emplace_back(row.strain, row.error_per_cell);
  std::sort(levels.begin(), levels.end());
  std::vector<double> strains, errors; // in the window of the claim
  double largest = 0.;                 // per strain
  for (const auto &[strain, error] : levels)
    if (strain >= 0.99e-4)
    {
      strains.push_back(strain);
      errors.push_back(error);
      largest = larger(largest, error / strain);
    }
  const std::string what  = cell + ", " + load + ": localized error against biot ",
                    claim = what + "falls as strain squared (slope)";
  if (strains.size() < 3)
    return {claim, Outcome::inconclusive, std::numeric_limits<double>::quiet_NaN(),
            "2 +- 0.1 over at least three levels from 1e-4 to 0.1"};
  if (!std::all_of(levels.begin(), levels.end(),
                   [](const auto &level) { return std::isfinite(level.second); }))
    return {claim, Outcome::fail, std::numeric_limits<double>::quiet_NaN(),
            "2 +- 0.1; an error is not a number"};
  if (largest < round_off)
    return {what + "is zero to round-off at every level, as where the law is linear in this load "
                   "(largest, per strain and cell side)",
            Outcome::pass, largest, "< 1e-10"};
  const double slope = log_slope(strains, errors);
  if (std::abs(slope - 2.) <= 0.1)
    return {claim, Outcome::pass, slope, "2 +- 0.1"};

  // Theory speaks of strains that are small against what the cell bears, which a weave, soft in shear, does not at 1 %; where its
  // symmetry leaves no quadratic term, the error falls faster.
  strains.clear();
  errors.clear();
  for (const auto &[strain, error] : levels)
    if (error > 10. * round_off * strain)
    {
      strains.push_back(strain);
      errors.push_back(error);
    }
  if (strains.size() < 3)
    return {claim, Outcome::inconclusive, slope,
            "2 +- 0.1; fewer than three levels above round-off: give larger --strains"};
  return verdict_of_smallest(
    what + "falls as strain squared or faster (slope at the three smallest levels)", strains,
    errors);
}

Verdict sheet_verdict(const std::string &cell, const std::string &load,
                      const std::vector<Row> &rows)
{
  const Row *affine = nullptr, *localized = nullptr;
  for (const Row &row : rows)
    if (row.cell == cell && row.load == load && row.reference == "biot")
      for (const auto &[method, best] :
           {std::make_pair("affine", &affine), std::make_pair("localized", &localized)})
        if (row.method == method &&
            (*best == nullptr ||
             std::abs(std::log(row.strain / 0.01)) < std::abs(std::log((*best)->strain / 0.01))))
          *best = &row;
  const std::string claim =
    cell + ", " + load +
    ": localized is closer to biot than affine near 1 % strain (ratio of errors)";
  const std::string limit = "< 1 by more than the reference's error bar";
  if (affine == nullptr || localized == nullptr || affine->strain != localized->strain)
    return {claim, Outcome::inconclusive, 0., limit};
  const double gain     = affine->error_m - localized->error_m;
  const double ratio    = localized->error_m / affine->error_m;
  const Outcome outcome = gain > localized->uncertainty_m    ? Outcome::pass
                          : gain < -localized->uncertainty_m ? Outcome::fail
                                                             : Outcome::inconclusive;
  return {claim, outcome, ratio, limit};
}
} // namespace

Verdict verdict_of_smallest(const std::string &claim, const std::vector<double> &strains,
                            const std::vector<double> &errors)
{
  const std::string limit = ">= 1.9";
  const auto between      = [&](const std::size_t k)
  { return std::log(errors[k + 1] / errors[k]) / std::log(strains[k + 1] / strains[k]); };
  const double first = between(0), second = between(1);
  if (std::abs(first - second) <= 0.1)
  {
    const double slope =
      log_slope({strains.begin(), strains.begin() + 3}, {errors.begin(), errors.begin() + 3});
    return {claim, slope >= 1.9 ? Outcome::pass : Outcome::fail, slope, limit};
  }
  // a e + b e² has slopes that rise from one to two; beyond, other powers are in play, unless the first is near one.
  if (first < 1.9 && first < second && (second <= 2.1 || first < 1.5))
    return {claim, Outcome::fail, first, limit};
  return {claim, Outcome::inconclusive, first,
          limit + "; the slopes at the three smallest levels still differ: give smaller --strains"};
}

double log_slope(const std::vector<double> &x, const std::vector<double> &y)
{
  const auto n  = static_cast<double>(x.size());
  double mean_x = 0., mean_y = 0., covariance = 0., variance = 0.;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    mean_x += std::log(x[k]) / n;
    mean_y += std::log(y[k]) / n;
  }
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    covariance += (std::log(x[k]) - mean_x) * (std::log(y[k]) - mean_y);
    variance += (std::log(x[k]) - mean_x) * (std::log(x[k]) - mean_x);
  }
  return covariance / variance;
}

std::vector<Verdict> strain_verdicts(const std::vector<std::vector<std::string>> &rows)
{
  const std::vector<Row> all = parsed(rows);
  std::vector<std::pair<std::string, std::string>> cases; // in the order of the rows
  for (const Row &row : all)
    if (row.reference == "biot" && row.method == "localized" &&
        std::find(cases.begin(), cases.end(), std::make_pair(row.cell, row.load)) == cases.end())
      cases.emplace_back(row.cell, row.load);
  std::vector<Verdict> verdicts;
  for (const auto &[cell, load] : cases)
    verdicts.push_back(load.rfind("periodic", 0) == 0 ? periodic_verdict(cell, load, all)
                                                      : sheet_verdict(cell, load, all));
  return verdicts;
}
} // namespace homespun::verification
