// SPDX-License-Identifier: MIT
#include "verification/budget_rows.h"

#include "verification/loads.h"
#include "verification/result_files.h"
#include "verification/strain_verdicts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace homespun::verification
{
const std::vector<std::string> &budget_columns()
{
  static const std::vector<std::string> columns = {"cell",  "load",          "strain", "reference",
                                                   "part",  "region",        "mean_m", "rms_m",
                                                   "max_m", "mean_per_cell", "share"};
  return columns;
}

const std::vector<std::string> &budget_regions()
{
  static const std::vector<std::string> regions = {"all", "interior", "boundary", "corner"};
  return regions;
}

std::vector<int> regions_of(const meshes::Sheet &sheet, const bool is_periodic)
{
  std::vector<int> regions(static_cast<std::size_t>(sheet.mesh.n_vertices()), 1);
  if (is_periodic)
    return regions;
  const double width = std::min(sheet.n1, sheet.n2) < 8 ? 1. : 2.;
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = sheet.fraction(sheet.mesh.vertices.row(v));
    const auto is_near         = [&](const double fraction, const int n)
    { return std::min(fraction, 1. - fraction) * n < width - 1e-6; };
    regions[static_cast<std::size_t>(v)] = 1 + is_near(f(0), sheet.n1) + is_near(f(1), sheet.n2);
  }
  return regions;
}

PartNorms norms_of(const meshes::Points &part, const meshes::Points &total,
                   const std::vector<int> &regions, const int region)
{
  PartNorms norms;
  double n = 0., sum_of_total = 0.;
  for (Eigen::Index v = 0; v < part.rows(); ++v)
    if (region == 0 || regions[static_cast<std::size_t>(v)] == region)
    {
      const double size = part.row(v).norm(), of_total = total.row(v).norm();
      norms.mean += size;
      norms.rms += size * size;
      norms.max = larger(norms.max, size);
      if (of_total > 0.)
        norms.share += part.row(v).dot(total.row(v)) / of_total;
      sum_of_total += of_total;
      n += 1.;
    }
  norms.mean /= n;
  norms.rms = std::sqrt(norms.rms / n);
  norms.share =
    sum_of_total > 0. ? norms.share / sum_of_total : std::numeric_limits<double>::quiet_NaN();
  return norms;
}

std::vector<std::vector<std::string>> budget_rows(const std::string &cell, const std::string &load,
                                                  const double strain, const std::string &reference,
                                                  const ErrorBudget &budget,
                                                  const std::vector<int> &regions,
                                                  const double side)
{
  const meshes::Points sum = budget.sum(), misfit = sum - budget.total;
  std::vector<std::pair<std::string, const meshes::Points *>> fields;
  for (const std::string &name : budget_parts())
    fields.emplace_back(name, &budget.parts.at(name));
  fields.emplace_back("sum", &sum);
  fields.emplace_back("misfit", &misfit);
  fields.emplace_back("total", &budget.total); // last: where it is there, so are all others
  std::vector<std::vector<std::string>> rows;
  for (const auto &[name, field] : fields)
    for (int region = 3; region >= 0; --region)
    {
      if (region > 0 && std::find(regions.begin(), regions.end(), region) == regions.end())
        continue;
      const PartNorms norms = norms_of(*field, budget.total, regions, region);
      rows.push_back({cell, load, csv_number(strain), reference, name,
                      budget_regions()[static_cast<std::size_t>(region)], csv_number(norms.mean),
                      csv_number(norms.rms), csv_number(norms.max), csv_number(norms.mean / side),
                      csv_number(norms.share)});
    }
  return rows;
}

namespace
{
using Rows = std::vector<std::vector<std::string>>;

/// Mean of a part over the whole sheet, per cell side; NaN where the row is not there.
double mean_of(const Rows &rows, const std::array<std::string, 4> &level, const std::string &part)
{
  double mean = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<std::string> &row : rows)
    if (std::equal(level.begin(), level.end(), row.begin()) && row[4] == part && row[5] == "all")
      mean = csv_value(row[9]);
  return mean;
}

constexpr double round_off = 1e-10; ///< in strain x cell side

void judge_level(const Rows &rows, const std::array<std::string, 4> &level,
                 std::vector<Verdict> &verdicts)
{
  const double strain    = csv_value(level[2]);
  const std::string what = level[0] + ", " + level[1] + " at " + csv_number(100. * strain) + " %: ";
  const double total = mean_of(rows, level, "total"), sum = mean_of(rows, level, "sum");
  if (total < round_off * strain)
  {
    verdicts.push_back({what + "the error is zero to round-off, and so is the sum of its parts "
                               "(per strain and cell side)",
                        sum < round_off * strain ? Outcome::pass : Outcome::fail, sum / strain,
                        "< 1e-10"});
    return;
  }
  const double effectivity = sum / total;
  verdicts.push_back({what + "the parts of the error add up (|sum of the parts| / |measured|)",
                      !std::isfinite(effectivity)                 ? Outcome::inconclusive
                      : effectivity >= 0.8 && effectivity <= 1.25 ? Outcome::pass
                                                                  : Outcome::fail,
                      effectivity, "0.8 to 1.25"});
  const auto at_most = [&](const char *part, const char *claim, const double limit)
  {
    const double value = mean_of(rows, level, part) / total;
    verdicts.push_back({what + claim,
                        !std::isfinite(value) ? Outcome::inconclusive
                        : value <= limit      ? Outcome::pass
                                              : Outcome::fail,
                        value, "<= " + csv_number(limit)});
  };
  at_most("misfit",
          "their sum is the measured error vertex by vertex (|sum - measured| / |measured|)",
          strain <= 0.0201 ? 0.1 : 0.25);
  at_most("solver", "what the solvers leave undone, over the measured error", 0.01);
  if (!Load(level[1]).is_periodic()) // whose affine motion is exact on any mesh
    at_most("resolution",
            "the homogenized sheet that counts as resolved is (change from a mesh half as fine, "
            "over the measured error)",
            0.1);
}

void judge_slope(const Rows &rows, const std::string &cell, const std::string &load,
                 const std::string &reference, std::vector<double> strains,
                 std::vector<Verdict> &verdicts)
{
  std::sort(strains.begin(), strains.end());
  std::vector<double> x, y, small_x, small_y;
  std::size_t n_round_off = 0;
  for (const double strain : strains)
    if (strain <= 0.0201) // beyond, the third order shows
      if (const double mean =
            mean_of(rows, {cell, load, csv_number(strain), reference}, "nonlinearity");
          std::isfinite(mean))
      {
        if (mean > 10. * round_off * strain)
        {
          small_x.push_back(strain);
          small_y.push_back(mean);
        }
        if (strain < 0.99e-4)
          continue;
        n_round_off += mean < round_off * strain;
        x.push_back(strain);
        y.push_back(mean);
      }
  const bool is_zero    = !x.empty() && n_round_off == x.size();
  const bool is_decided = is_zero || (x.size() >= 3 && n_round_off == 0);
  const double slope =
    is_decided && !is_zero ? log_slope(x, y) : std::numeric_limits<double>::quiet_NaN();
  const std::string what =
    cell + ", " + load + ": geometric nonlinearity, measured apart, grows as strain squared";
  // 2 % is not small for a weave, and symmetry may leave no quadratic term.
  if (std::abs(slope - 2.) > 0.1 && small_x.size() >= 3)
  {
    verdicts.push_back(verdict_of_smallest(what + " or faster (slope at the three smallest levels)",
                                           small_x, small_y));
    return;
  }
  verdicts.push_back(
    {what + " up to 2 % (slope" + (is_zero ? "; zero to round-off at every level)" : ")"),
     !is_decided                              ? Outcome::inconclusive
     : is_zero || std::abs(slope - 2.) <= 0.1 ? Outcome::pass
                                              : Outcome::fail,
     slope, "2 +- 0.1 over at least three levels, or zero to round-off"});
}
} // namespace

std::vector<Verdict> budget_verdicts(const Rows &strain_rows, const Rows &budget_rows)
{
  std::vector<std::array<std::string, 3>> cases; // cell, load, reference in the order of the rows
  std::string reference;
  for (const std::vector<std::string> &row : strain_rows)
    if (row[3] == "biot" || reference.empty())
      reference = row[3];
  for (const std::vector<std::string> &row : strain_rows)
    if (const std::array<std::string, 3> one = {row[0], row[1], reference};
        row[3] == reference && std::find(cases.begin(), cases.end(), one) == cases.end())
      cases.push_back(one);
  std::vector<Verdict> verdicts;
  for (const auto &[cell, load, law] : cases)
  {
    std::vector<double> strains;
    for (const std::vector<std::string> &row : strain_rows)
      if (row[0] == cell && row[1] == load && row[3] == law)
        strains.push_back(csv_value(row[2]));
    std::sort(strains.begin(), strains.end());
    strains.erase(std::unique(strains.begin(), strains.end()), strains.end());
    for (const double wanted : {0.01, 0.1})
    {
      const auto distance = [&](const double strain)
      { return std::abs(std::log(strain / wanted)); };
      const double nearest = *std::min_element(strains.begin(), strains.end(),
                                               [&](const double a, const double b)
                                               { return distance(a) < distance(b); });
      if (distance(nearest) < std::log(1.5))
        judge_level(budget_rows, {cell, load, csv_number(nearest), law}, verdicts);
    }
    judge_slope(budget_rows, cell, load, law, strains, verdicts);
  }
  return verdicts;
}
} // namespace homespun::verification
