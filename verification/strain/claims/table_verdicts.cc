// SPDX-License-Identifier: MIT
#include "verification/strain/claims/table_verdicts.h"

#include "meshes/plain/epsilon.h"
#include "verification/law/laws.h"
#include "verification/method/method.h"
#include "verification/record/claim.h"
#include "verification/strain/claims/strain_verdicts.h"
#include "verification/strain/strain_cases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace homespun::verification
{
namespace
{
/// Rounding of sums over a million vertices.
constexpr double rounding = 1e-12;

/// Of the vertices of a sheet, the part that belongs to a triangle of a cell at an edge.
double share_at_edges(const meshes::Sheet &sheet)
{
  std::vector<char> is_at_edge(static_cast<std::size_t>(sheet.mesh.n_vertices()), 0);
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
  {
    Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
    for (int i = 0; i < 3; ++i)
      centre += sheet.mesh.vertices.row(sheet.mesh.triangles(t, i)) / 3.;
    const Eigen::RowVector2d place =
      sheet.fraction(centre).cwiseProduct(Eigen::RowVector2d(sheet.n1, sheet.n2));
    if ((place.array() > 1.).all() && place(0) < sheet.n1 - 1. && place(1) < sheet.n2 - 1.)
      continue;
    for (int i = 0; i < 3; ++i)
      is_at_edge[static_cast<std::size_t>(sheet.mesh.triangles(t, i))] = 1;
  }
  return static_cast<double>(std::count(is_at_edge.begin(), is_at_edge.end(), 1)) /
         static_cast<double>(is_at_edge.size());
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

std::vector<Verdict> verdicts_of_parts(const std::vector<StrainRow> &rows,
                                       const homogenization::UnitCell &cell)
{
  double worst    = 0.;
  int n_rows      = 0;
  double at_edges = -1.;
  for (const StrainRow &row : rows)
    if (row.cell == cell.name && std::isfinite(row.interior) && row.mean > 0.)
    {
      if (n_rows == 0)
        at_edges = share_at_edges(meshes::tile(cell.mesh, cell.lattice, row.cells, row.cells));
      const double mean = (1. - at_edges) * row.interior + at_edges * row.edge;
      worst             = larger(worst, std::abs(mean / row.mean - 1.));
      ++n_rows;
    }
  if (n_rows == 0)
    return {};
  return {at_most("parts-of-mean", {{"cell", cell.name}, {"rows", n_rows}}, worst, rounding)};
}

std::vector<Verdict> verdicts_of_proportions(const std::vector<StrainRow> &rows,
                                             const std::vector<ForceRow> &forces,
                                             const homogenization::UnitCell &cell,
                                             const double left)
{
  // Least and largest of each load and method, over strain.
  std::map<std::vector<std::string>, std::pair<double, double>> ranges;
  std::set<double> strains;
  const auto add = [&](const auto &row, const char *what, const double value, const double scale)
  {
    if (row.cell != cell.name || row.reference != name_of(Law::linear) || !std::isfinite(value))
      return;
    strains.insert(row.strain);
    const double next = value / (row.strain * scale);
    auto &[least, most] =
      ranges.try_emplace({what, row.load, row.method}, next, next).first->second;
    std::tie(least, most) = std::pair(std::min(least, next), std::max(most, next));
  };
  for (const StrainRow &row : rows)
    add(row, "error", row.mean, row.cells * std::sqrt(cell.lattice.area()));
  for (const ForceRow &row : forces)
    add(row, "force", row.per_width, 1.);
  if (strains.size() < 2)
    return {};
  double worst = 0.;
  for (const auto &[of, range] : ranges)
    worst =
      larger(worst, (range.second - range.first) / (of[0] == "error" ? 1. : std::abs(range.first)));
  return {at_most("proportional", {{"cell", cell.name}}, worst, left)};
}

bool prescribes_motion(const Load &load)
{
  return load.is_periodic() && !load.has_free_sides();
}

Verdict verdict_of_triangles(const std::vector<UncertaintyRow> &rows)
{
  int n_wrong = 0, n_rows = 0;
  const auto is_triangle = [](double a, double b, double c)
  {
    const double longest = std::max({a, b, c});
    return a + b + c - longest >= (1. - rounding) * longest;
  };
  for (const UncertaintyRow &row : rows)
  {
    if (!std::isfinite(row.p1_to_refined) || !std::isfinite(row.p2_to_refined))
      continue;
    ++n_rows;
    n_wrong += !is_triangle(row.p1_to_p2, row.p1_to_refined, row.p2_to_refined) ||
               (std::isfinite(row.p1_to_p2_max) &&
                !is_triangle(row.p1_to_p2_max, row.p1_to_refined_max, row.p2_to_refined_max));
  }
  return open_without(n_rows, at_most("triangles", {{"rows", n_rows}}, n_wrong, 0.));
}

Verdict verdict_of_prescribed_motion(const std::vector<UncertaintyRow> &rows,
                                     const homogenization::UnitCell &cell)
{
  int n_rows    = 0;
  double worst  = 0.;
  const auto is = [&](const UncertaintyRow &row, const char *method)
  { return row.cell == cell.name && row.method == method && std::isfinite(row.p1_to_p2); };
  for (const UncertaintyRow &row : rows)
    for (const UncertaintyRow &other : rows)
    {
      if (!is(row, "affine") || !is(other, UncertaintyRow::of_reference) ||
          !prescribes_motion(Load(row.load)) || row.load != other.load ||
          row.reference != other.reference || row.strain != other.strain)
        continue;
      ++n_rows;
      for (const auto distance : {&UncertaintyRow::p1_to_p2, &UncertaintyRow::p1_to_refined,
                                  &UncertaintyRow::p2_to_refined})
        worst = larger(worst, std::abs(row.*distance - other.*distance));
    }
  // Coordinates far from the origin have fewer digits.
  const double side   = std::sqrt(cell.lattice.area()),
               digits = meshes::epsilon * (1. + cell.mesh.vertices.cwiseAbs().maxCoeff() / side),
               limit  = 16. * digits;
  return open_without(n_rows,
                      at_most("bars-of-prescribed-motion", {{"cell", cell.name}, {"rows", n_rows}},
                              worst / side, limit));
}

Verdict verdict_of_bases(const std::vector<GainRow> &gains, const std::vector<StrainRow> &rows)
{
  int n_wrong = 0; // said here again: a wrong choice in gains.cc is to be seen
  for (const GainRow &gain : gains)
  {
    const Method method(gain.method), coarse = method.without(Term::micro), p2("affine+p2");
    double of_base = GainRow::none, least = std::numeric_limits<double>::infinity();
    for (const StrainRow &row : rows)
      if (is_of_case(row, gain) && row.strain == gain.strain && std::isfinite(row.mean))
      {
        const Method its(row.method);
        if (row.method == gain.base)
          of_base = row.mean;
        if (its.has_terms_of(coarse) || (method.has(Term::p2) && its.has_terms_of(p2)))
          least = std::min(least, row.mean);
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

Verdict verdict_of_reading(const std::vector<StrainRow> &rows, const std::string &folder)
{
  return at_most("read-back", {{"rows", rows.size()}}, n_rows_read_otherwise(rows, folder), 0.);
}
} // namespace homespun::verification
