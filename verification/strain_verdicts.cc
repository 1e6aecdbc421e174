// SPDX-License-Identifier: MIT
#include "verification/strain_verdicts.h"

#include "verification/result_files.h"

#include <algorithm>
#include <limits>

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
  std::vector<double> strains, errors;
  for (const Row &row : rows)
    if (row.cell == cell && row.load == load && row.reference == "biot" &&
        row.method == "localized" && row.strain >= 0.99e-4 && row.strain <= 0.101)
    {
      strains.push_back(row.strain);
      errors.push_back(row.error_per_cell);
    }
  const std::string what = cell + ", " + load + ": localized error against biot ";
  if (strains.size() < 3)
    return {what + "falls as strain squared (slope)", Outcome::inconclusive,
            std::numeric_limits<double>::quiet_NaN(),
            "2 +- 0.1 over at least three levels from 1e-4 to 0.1"};
  double largest = 0.; // per strain
  for (std::size_t k = 0; k < strains.size(); ++k)
    largest = std::max(largest, errors[k] / strains[k]);
  if (largest < round_off)
    return {what + "is zero to round-off at every level, as where the law is linear in this load "
                   "(largest, per strain and cell side)",
            Outcome::pass, largest, "< 1e-10"};
  const double slope = log_slope(strains, errors);
  return {what + "falls as strain squared (slope)",
          std::abs(slope - 2.) <= 0.1 ? Outcome::pass : Outcome::fail, slope, "2 +- 0.1"};
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
