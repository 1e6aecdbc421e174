// SPDX-License-Identifier: MIT
#include "verification/strain/claims/table_verdicts.h"

#include "verification/law/laws.h"
#include "verification/record/number_text.h"
#include "verification/reference/loads.h"
#include "verification/strain/claims/strain_verdicts.h"

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

/// Cell and load of rows in linear theory on a sheet, in the order of the rows.
template <typename Row>
std::vector<std::pair<std::string, std::string>> linear_sheets_of(const std::vector<Row> &rows)
{
  std::vector<std::pair<std::string, std::string>> all;
  for (const Row &row : rows)
  {
    const std::pair<std::string, std::string> one = {row.cell, row.load};
    if (row.reference == name_of(Law::linear) && !Load(row.load).is_periodic() &&
        std::find(all.begin(), all.end(), one) == all.end())
      all.push_back(one);
  }
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
  return {"strain.csv: mean <= root mean square <= largest error in each of " +
            std::to_string(n_rows) + " rows (rows where not)",
          n_wrong == 0 ? Outcome::pass : Outcome::fail,
          static_cast<double>(n_wrong),
          "0",
          "Cauchy and Schwarz",
          Kind::program};
}

std::vector<Verdict> verdicts_of_nested_forces(const std::vector<UncertaintyRow> &rows)
{
  std::vector<Verdict> verdicts;
  for (const auto &[cell, load] : linear_sheets_of(rows))
  {
    double least = std::numeric_limits<double>::infinity(), most = 0., misfit = 0.;
    for (const UncertaintyRow &row : rows)
      if (row.cell == cell && row.load == load && row.reference == name_of(Law::linear) &&
          std::isfinite(row.force_p1_to_refined))
      {
        least  = std::min({least, row.force_p1_to_p2, row.force_p2_to_refined});
        most   = larger(most, row.force_p1_to_refined);
        misfit = larger(
          misfit, std::abs(row.force_p1_to_refined - row.force_p1_to_p2 - row.force_p2_to_refined));
      }
    if (most <= solved_to)
      continue; // nothing was measured, or P1 is exact
    // Distances of three numbers on a line add up only where the middle one lies between.
    verdicts.push_back(
      {cell + ", " + load +
         " in linear theory: the force of the error bar's sheets falls from P1 to "
         "P2 to refined P2 (smallest fall over the force)",
       least > solved_to && misfit <= 2. * solved_to ? Outcome::pass : Outcome::fail,
       misfit <= 2. * solved_to ? least : -misfit, "> " + short_text(solved_to),
       "the force is twice the energy over the way of the clamp, and the least "
       "energy of a larger space is smaller unless P1 is exact; the references "
       "stop where 1e-9 of their forces is left",
       Kind::program});
  }
  return verdicts;
}

std::vector<Verdict> verdicts_of_forces(const std::vector<ForceRow> &rows)
{
  std::vector<Verdict> verdicts;
  for (const auto &[cell, load] : linear_sheets_of(rows))
  {
    std::map<double, std::pair<double, double>> of_strain; // resolved, affine
    for (const ForceRow &row : rows)
      if (row.cell == cell && row.load == load && row.reference == name_of(Law::linear))
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
        {cell + ", " + load +
           " in linear theory: the reference pulls back, no harder than the affine motion would "
           "(ratio of forces, worst level)",
         worst > 0. && worst <= 1. + 10. * solved_to ? Outcome::pass : Outcome::fail, worst,
         "> 0 and <= 1",
         "the force is twice the energy over the way of the clamp: positive, and the affine motion "
         "is one that the reference may choose; 1e-8 for the derivative of the affine motion's "
         "energy and what the references leave",
         Kind::program});
  }
  return verdicts;
}

Verdict verdict_of_reading(const std::vector<StrainRow> &rows, const std::string &folder)
{
  const int n_other = n_rows_read_otherwise(rows, folder);
  return {"strain.csv gives back each of " + std::to_string(rows.size()) +
            " rows to the last bit (rows that it does not)",
          n_other == 0 ? Outcome::pass : Outcome::fail,
          static_cast<double>(n_other),
          "0",
          "numbers are written with as many digits as name them uniquely",
          Kind::program};
}
} // namespace homespun::verification
