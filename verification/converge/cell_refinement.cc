// SPDX-License-Identifier: MIT
#include "verification/converge/cell_refinement.h"

#include "homogenization/cell/laminate.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/energy_order.h"

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
/// Relative changes of C^H below this are round-off and what solvers leave, whose residuals of
/// 1e-11 enter an energy squared.
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

/// A measured difference of two C^H beside what round-off may make of it: of all levels the one
/// that comes nearest to its limit, or goes farthest beyond.
struct Difference
{
  double value = 0., limit = 0.;

  void add(const double next, const double its_limit)
  {
    if (limit == 0. || std::isnan(next) || next / its_limit > value / limit)
      *this = {next, its_limit};
  }
};

/// Within the limit is PASS, as long as the limit is one: where round-off takes more of an energy
/// than this, a C^H within its limit is known to no digit worth the name.
Outcome outcome_of(const Difference &difference)
{
  constexpr double vacuous = 1e-6;
  if (!(difference.value <= difference.limit))
    return Outcome::fail;
  return difference.limit <= vacuous ? Outcome::pass : Outcome::inconclusive;
}

/// What round-off leaves open in the C^H of a level, and at least a floor.
class RoundOff
{
public:
  explicit RoundOff(const UnitCell &cell)
      : cell(cell)
  {
  }

  double of(const RefinedCell &level, const double floor) const
  {
    // Two degrees of freedom per node, as many nodes along a side as rows.
    return std::max(floor,
                    algebraic_limit(cell, std::sqrt(0.5 * static_cast<double>(level.n_dofs))));
  }

private:
  const UnitCell &cell;
};

/// Largest violation of the Loewner order from level to level.
Difference rise_of(const std::vector<RefinementLadder> &ladders, const RoundOff &round_off)
{
  Difference violation;
  for (const RefinementLadder &ladder : ladders)
    for (std::size_t k = 1; k < ladder.levels.size(); ++k)
      violation.add(order_violation(ladder.levels[k].stiffness, ladder.levels[k - 1].stiffness),
                    round_off.of(ladder.levels[k], stiffness_floor));
  return violation;
}

/// At corners the ladder falls, and turned round it rises: what says that the check can fail.
Verdict check_can_fail(std::vector<RefinementLadder> ladders, const RoundOff &round_off)
{
  for (RefinementLadder &ladder : ladders)
    std::reverse(ladder.levels.begin(), ladder.levels.end());
  const Difference rise = rise_of(ladders, round_off);
  return judged("rise-is-found", {{"limit", number(rise.limit)}},
                rise.value > rise.limit ? Outcome::pass : Outcome::fail, rise.value);
}

Verdict nested(const std::vector<RefinementLadder> &ladders, const RoundOff &round_off)
{
  const Difference violation = rise_of(ladders, round_off);
  return judged("nested-levels", {{"limit", number(violation.limit)}},
                violation.limit > 0. ? outcome_of(violation) : Outcome::inconclusive,
                violation.value);
}

Verdict is_laminate(const UnitCell &cell, const std::vector<RefinementLadder> &ladders,
                    const RoundOff &round_off)
{
  const Eigen::Matrix3d exact =
    homogenization::laminate_stiffness(cell.mesh, cell.lattice, cell.stiffness_of_phase());
  Difference distance;
  for (const RefinementLadder &ladder : ladders)
    for (const RefinedCell &level : ladder.levels)
      distance.add(energy_difference(level.stiffness, exact),
                   round_off.of(level, closed_form_limit));
  return judged("mesh-changes.laminate", {{"limit", number(distance.limit)}}, outcome_of(distance),
                distance.value);
}

Verdict changes_with_the_mesh(const std::vector<RefinementLadder> &ladders,
                              const Singularity &singularity, const RoundOff &round_off)
{
  const RefinedCell &finest = ladders.back().levels.back();
  double change             = 0.;
  for (const RefinementLadder &ladder : ladders)
    for (const RefinedCell &level : ladder.levels)
      change = larger(change, energy_difference(level.stiffness, finest.stiffness));
  const double noise = round_off.of(finest, stiffness_floor);
  // Corners that are a rounding of coordinates, or between phases that hardly differ, change it by
  // less.
  constexpr double weak = 1e-4;
  const bool is_strong  = singularity.exists && singularity.strongest < 1. - weak;
  const Outcome outcome = change > noise       ? Outcome::pass
                          : std::isnan(change) ? Outcome::fail
                          : !is_strong         ? Outcome::inconclusive
                          : noise > stiffness_floor && change > stiffness_floor
                            ? Outcome::inconclusive // round-off may hide it
                            : Outcome::fail;
  return judged("mesh-changes.corners", {{"limit", number(noise)}}, outcome, change);
}

/// P2 contains P1 on the same mesh, and at corners it is not P1: what tells one from the other
/// there, where both have the order of the corners.
Verdict quadratic_lies_below(const std::vector<RefinementLadder> &ladders,
                             const Singularity &singularity, const RoundOff &round_off)
{
  Difference violation;
  double least = std::numeric_limits<double>::infinity(), noise = stiffness_floor;
  for (const RefinedCell &linear : ladders[0].levels)
    for (const RefinedCell &quadratic : ladders[1].levels)
      if (linear.h == quadratic.h)
      {
        const double limit = round_off.of(quadratic, stiffness_floor);
        violation.add(order_violation(quadratic.stiffness, linear.stiffness), limit);
        noise               = std::max(noise, limit);
        const double change = energy_difference(linear.stiffness, quadratic.stiffness);
        if (!(change >= least))
          least = change;
      }
  constexpr double weak = 1e-4; // as in changes_with_the_mesh()
  const bool is_strong  = singularity.exists && singularity.strongest < 1. - weak;
  Outcome outcome       = outcome_of(violation);
  if (outcome == Outcome::pass && !(least > noise))
    outcome = is_strong && noise <= stiffness_floor ? Outcome::fail : Outcome::inconclusive;
  return judged("quadratic-below-linear", {{"limit", number(noise)}},
                violation.limit > 0. ? outcome : Outcome::inconclusive, least);
}

/// Whether the limits of both orders are one value, by their error bars.
Verdict limits_agree(const Series &p1, const Series &p2)
{
  Verdict verdict =
    judged("limits-agree", {}, Outcome::inconclusive, std::numeric_limits<double>::quiet_NaN());
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
  const bool has_corners = !corners.empty();
  const RoundOff round_off(cell);
  result.verdicts.push_back(nested(ladders, round_off));
  const Singularity singularity = homogenization::singularity_of(corners);
  result.verdicts.push_back(has_corners ? changes_with_the_mesh(ladders, singularity, round_off)
                                        : is_laminate(cell, ladders, round_off));
  if (has_corners && result.verdicts.back().outcome == Outcome::pass)
    result.verdicts.push_back(check_can_fail(ladders, round_off));
  if (has_corners && ladders.size() == 2)
    result.verdicts.push_back(quadratic_lies_below(ladders, singularity, round_off));
  const std::string exponents =
    singularity.exists
      ? "the energy converges with at least twice the exponent of the strongest corner, 2 x " +
          number(singularity.strongest) + ", and at most twice the smallest above 1, 2 x " +
          number(singularity.next)
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
    const double floor =
      round_off.of(ladder.levels.back(), stiffness_floor) * ladder.levels.back().stiffness.norm();
    trace.judgement = judge_values(trace.sizes(), trace.values(), limit, floor);
    trace.extrapolate(floor, 2. * ladder.order, *trace.judgement);
    traces.push_back(trace);
    result.add(trace, "order-of-corners",
               {{"exponents", exponents},
                {"order", ladder.order == 1 ? ", with P1 at most 2; P1" : "; P2"}});
    // Entries are no energies each: reported, and with a limit only where they follow a power of h
    // as the trace does.
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
