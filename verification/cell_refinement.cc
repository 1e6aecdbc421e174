// SPDX-License-Identifier: MIT
#include "verification/cell_refinement.h"

#include "homogenization/laminate.h"
#include "verification/algebraic_limit.h"
#include "verification/energy_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace homespun::verification
{
using homogenization::Singularity;
using homogenization::UnitCell;

namespace
{
/// Relative changes of C^H below this are round-off and what solvers leave, whose residuals of 1e-11 enter an
/// energy squared.
constexpr double stiffness_floor = 1e-10;

/// A laminate differs from its closed form by the digits of its mesh's coordinates as well.
constexpr double closed_form_limit = 1e-9;

constexpr double order_tolerance = 0.1;

std::string number(const double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

Verdict within(const std::string &claim, const double value, const bool holds,
               const std::string &limit)
{
  return {claim, holds ? Outcome::pass : Outcome::fail, value, limit};
}

Series series_of(const RefinementLadder &ladder, const std::string &quantity,
                 double (*function)(const Eigen::Matrix3d &))
{
  Series series;
  series.quantity = quantity;
  series.order    = ladder.order;
  series.h_unit   = "cell side";
  for (const RefinedCell &level : ladder.levels)
    series.levels.push_back(
      {level.h, level.n_dofs, function(level.stiffness), std::nullopt, level.seconds});
  return series;
}

/// Largest violation of the Loewner order from level to level.
Verdict nested(const std::vector<RefinementLadder> &ladders, const double round_off)
{
  double violation = 0.;
  for (const RefinementLadder &ladder : ladders)
    for (std::size_t k = 1; k < ladder.levels.size(); ++k)
      violation = larger(
        violation, order_violation(ladder.levels[k].stiffness, ladder.levels[k - 1].stiffness));
  return within(
    "C^H falls from level to level in the Loewner order: P1 and P2 (largest relative rise of an "
    "energy)",
    violation, violation <= std::max(stiffness_floor, round_off),
    "<= " + number(std::max(stiffness_floor, round_off)));
}

Verdict is_laminate(const UnitCell &cell, const std::vector<RefinementLadder> &ladders,
                    const double round_off)
{
  const Eigen::Matrix3d exact =
    homogenization::laminate_stiffness(cell.mesh, cell.lattice, cell.stiffness_of_phase());
  double distance = 0.;
  for (const RefinementLadder &ladder : ladders)
    for (const RefinedCell &level : ladder.levels)
      distance = larger(distance, energy_difference(level.stiffness, exact));
  return within(
    "C^H is the closed form of the laminate on every level and for both orders; the cell has no "
    "corners (largest relative difference of an energy)",
    distance, distance <= std::max(closed_form_limit, round_off),
    "<= " + number(std::max(closed_form_limit, round_off)));
}

Verdict changes_with_the_mesh(const std::vector<RefinementLadder> &ladders,
                              const Singularity &singularity, const double round_off)
{
  double change = 0.;
  for (const RefinementLadder &ladder : ladders)
    for (const RefinedCell &level : ladder.levels)
      change =
        larger(change, energy_difference(level.stiffness, ladders.back().levels.back().stiffness));
  Verdict verdict = within(
    "C^H changes with mesh and order as it must at corners (largest relative difference of an "
    "energy)",
    change, change > std::max(stiffness_floor, round_off),
    "> " + number(std::max(stiffness_floor, round_off)));
  // Corners that are a rounding of coordinates, or between phases that hardly differ, change it by less.
  constexpr double weak = 1e-4;
  if (verdict.outcome == Outcome::fail && std::isfinite(change) &&
      !(singularity.exists && singularity.strongest < 1. - weak))
    verdict.outcome = Outcome::inconclusive;
  return verdict;
}

/// Whether the limits of both orders are one value, by their error bars.
Verdict limits_agree(const Series &p1, const Series &p2)
{
  Verdict verdict = {
    "Richardson limits of P1 and P2 agree (their distance over the sum of both error bars)",
    Outcome::inconclusive, std::numeric_limits<double>::quiet_NaN(),
    "<= 1 where both orders have settled"};
  if (p1.has_error_bar() && p2.has_error_bar())
  {
    verdict.value = std::abs(p1.richardson->limit - p2.richardson->limit) /
                    (p1.richardson->gci + p2.richardson->gci);
    verdict.outcome = verdict.value <= 1. ? Outcome::pass : Outcome::fail;
  }
  return verdict;
}

const std::array<std::pair<const char *, double (*)(const Eigen::Matrix3d &)>, 6> entries = {
  {{"C11 [N/m]", [](const Eigen::Matrix3d &C) { return C(0, 0); }},
   {"C22 [N/m]", [](const Eigen::Matrix3d &C) { return C(1, 1); }},
   {"C66 [N/m]", [](const Eigen::Matrix3d &C) { return C(2, 2); }},
   {"C12 [N/m]", [](const Eigen::Matrix3d &C) { return C(0, 1); }},
   {"C16 [N/m]", [](const Eigen::Matrix3d &C) { return C(0, 2); }},
   {"C26 [N/m]", [](const Eigen::Matrix3d &C) { return C(1, 2); }}}};
} // namespace

OrderLimit order_of_energy(const Singularity &singularity, const unsigned int order)
{
  const double highest = 2. * order;
  if (!singularity.exists) // weaker than any strain: an exponent between 1 and 2 at most
    return {2. - order_tolerance, highest + order_tolerance};
  return {2. * singularity.strongest - order_tolerance,
          std::min(highest, 2. * singularity.next) + order_tolerance};
}

void judge_refinements(const UnitCell &cell, const std::vector<RefinementLadder> &ladders,
                       ConvergenceResult &result)
{
  for (const RefinementLadder &ladder : ladders)
    if (ladder.levels.empty())
      return; // there is nothing to hold it against
  const auto corners =
    homogenization::corners_of(cell.mesh, cell.lattice, cell.stiffness_of_phase());
  const bool has_corners  = !corners.empty();
  unsigned long most_dofs = 0;
  for (const RefinementLadder &ladder : ladders)
    for (const RefinedCell &level : ladder.levels)
      most_dofs = std::max(most_dofs, level.n_dofs);
  // Two degrees of freedom per node, as many nodes along a side as rows.
  const double round_off = algebraic_limit(cell, std::sqrt(0.5 * static_cast<double>(most_dofs)));
  result.verdicts.push_back(nested(ladders, round_off));
  const Singularity singularity = homogenization::singularity_of(corners);
  result.verdicts.push_back(has_corners ? changes_with_the_mesh(ladders, singularity, round_off)
                                        : is_laminate(cell, ladders, round_off));
  const std::string exponents =
    singularity.exists ? "the energy converges with twice the exponents of the corners: from 2 x " +
                           number(singularity.strongest) + " to 2 x " + number(singularity.weakest)
                       : std::string("the corners have no exponent below 1");
  std::vector<Series> traces;
  for (const RefinementLadder &ladder : ladders)
  {
    Series trace =
      series_of(ladder, "trace of C^H [N/m]", [](const Eigen::Matrix3d &C) { return C.trace(); });
    if (!has_corners)
    {
      result.add(trace);
      for (const auto &[name, function] : entries)
        result.add(series_of(ladder, name, function));
      continue;
    }
    const OrderLimit limit = order_of_energy(singularity, ladder.order);
    const double floor     = stiffness_floor * ladder.levels.back().stiffness.norm();
    trace.judgement        = judge_values(trace.sizes(), trace.values(), limit, floor);
    trace.extrapolate(floor, 2. * ladder.order, *trace.judgement);
    traces.push_back(trace);
    result.add(trace, exponents + (ladder.order == 1 ? "; smooth parts with 2; P1" : "; P2"));
    // Entries are no energies each: reported, and with a limit only where they follow a power of h as the trace does.
    for (const auto &[name, function] : entries)
    {
      Series entry = series_of(ladder, name, function);
      entry.extrapolate(floor, 2. * ladder.order,
                        judge_values(entry.sizes(), entry.values(), limit, floor));
      result.add(entry);
    }
  }
  if (traces.size() == 2)
    result.verdicts.push_back(limits_agree(traces[0], traces[1]));
}
} // namespace homespun::verification
