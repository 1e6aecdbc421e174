// SPDX-License-Identifier: MIT
#include "verification/strain/budget/budget_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
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

double strain_nearest_to(const double wanted, const std::vector<double> &strains)
{
  const auto distance = [&](const double strain) { return std::abs(std::log(strain / wanted)); };
  return *std::min_element(strains.begin(), strains.end(),
                           [&](const double a, const double b)
                           { return distance(a) < distance(b); });
}

std::vector<double> judged_strains(const std::vector<double> &strains)
{
  std::vector<double> judged;
  for (const double wanted : {0.01, 0.1})
    if (!strains.empty())
      if (const double nearest = strain_nearest_to(wanted, strains);
          std::abs(std::log(nearest / wanted)) < std::log(1.5))
        judged.push_back(nearest);
  return judged;
}

bool is_small(const double strain)
{
  return strain <= 0.0201;
}

bool decides_order(const double strain)
{
  return strain >= 0.99e-4 && is_small(strain);
}

bool decide_order(const std::vector<double> &strains)
{
  return std::count_if(strains.begin(), strains.end(), decides_order) >= 3;
}

BudgetExtent budget_extent(const double strain, const std::vector<double> &strains)
{
  const std::vector<double> judged = judged_strains(strains);
  if (judged.empty() || std::find(judged.begin(), judged.end(), strain) != judged.end())
    return BudgetExtent::whole;
  return is_small(strain) && decide_order(strains) ? BudgetExtent::order : BudgetExtent::none;
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

std::vector<BudgetRow> budget_rows(const BudgetRow &level, const ErrorBudget &budget,
                                   const std::vector<int> &regions, const double side)
{
  const meshes::Points sum = budget.sum(), unexplained = budget.total - sum;
  std::vector<std::pair<std::string, const meshes::Points *>> fields;
  for (const std::string &name : budget_parts())
    if (const auto part = budget.parts.find(name); part != budget.parts.end())
      fields.emplace_back(name, &part->second);
  if (budget.is_whole())
  {
    fields.emplace_back("sum", &sum);
    fields.emplace_back("unexplained", &unexplained);
  }
  fields.emplace_back("total", &budget.total); // last: where it is there, so are all others
  std::vector<BudgetRow> rows;
  BudgetRow bar = level;
  bar.part      = "unexplained-bar";
  bar.region    = budget_regions().front();
  bar.mean      = budget.bar;
  bar.per_cell  = bar.mean / side;
  if (std::isfinite(bar.mean))
    rows.push_back(bar);
  for (const auto &[name, field] : fields)
    for (int region = 3; region >= 0; --region)
    {
      if (region > 0 && std::find(regions.begin(), regions.end(), region) == regions.end())
        continue;
      const PartNorms norms = norms_of(*field, budget.total, regions, region);
      BudgetRow row         = level;
      row.part              = name;
      row.region            = budget_regions()[static_cast<std::size_t>(region)];
      row.mean              = norms.mean;
      row.rms               = norms.rms;
      row.max               = norms.max;
      row.per_cell          = norms.mean / side;
      row.share             = norms.share;
      rows.push_back(row);
    }
  return rows;
}
} // namespace homespun::verification
