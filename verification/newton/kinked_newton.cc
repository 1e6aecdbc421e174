// SPDX-License-Identifier: MIT
#include "verification/newton/kinked_newton.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace homespun::verification
{
namespace
{
constexpr double least_times = 1e-5, most_times = 1e3;

/// Where the slope along a step is half of what it was at most, by false position.
class SlopeSearch
{
public:
  SlopeSearch(KinkedProblem &problem, const NewtonState &now, const double slope)
      : problem(problem)
      , now(now)
      , slope(slope)
  {
  }

  /// @return length of the step to `next`; 0 where there is none
  double find(NewtonState &next)
  {
    constexpr int most_trials = 25;
    double length = 1., before = 0., slope_before = slope, behind = 0., slope_behind = 0.;
    for (int trial = 0; trial < most_trials; ++trial)
    {
      next               = problem.at(length);
      const double there = problem.slope_there();
      const bool is_low  = next.energy <= now.energy + now.energy_round_off;
      if (is_low && (std::abs(there) <= 0.5 * std::abs(slope) || (there < 0. && length == 1.)))
        return length;
      if (!is_low || there > 0.)
      {
        behind       = length;
        slope_behind = is_low && there > 0. ? there : -slope_before; // not low: the middle
      }
      else
      {
        before       = length;
        slope_before = there;
      }
      const double part = slope_before / (slope_before - slope_behind);
      length            = before + (behind - before) * std::clamp(part, 0.1, 0.9);
    }
    return 0.;
  }

private:
  KinkedProblem &problem;
  const NewtonState &now;
  const double slope;
};
} // namespace

void minimize_with_kinks(KinkedProblem &problem, const NewtonOptions &options)
{
  NewtonState now = problem.state();
  double times    = 1.;
  std::vector<double> history;
  while (true)
  {
    history.push_back(now.residual / (now.size > 0. ? now.size : 1.));
    if (!std::isfinite(now.residual) || !std::isfinite(now.energy))
      throw meshes::NotConverged("Newton's method: the energy or the forces are not finite",
                                 history);
    if (now.residual <= now.least)
      return;
    if (history.size() > options.most_steps)
      throw meshes::NotConverged("Newton's method stalls", history);

    problem.steady(times);
    const double slope = problem.find_step(Tangent::projected, options.largest_reduction);
    NewtonState next;
    const double length = SlopeSearch(problem, now, slope).find(next);
    if (length == 0.)
    {
      if (times >= most_times)
        throw meshes::NotConverged("the line search found no lower energy", history);
      times = std::min(10. * times, most_times);
      continue;
    }
    problem.keep(length, next.residual / now.residual);
    const double growth = length < 0.1 ? 10. : 3.;
    times =
      length == 1. ? std::max(0.2 * times, least_times) : std::min(growth * times, most_times);
    now = next;
  }
}
} // namespace homespun::verification
