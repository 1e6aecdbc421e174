// SPDX-License-Identifier: MIT
#include "verification/newton/newton.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace homespun::verification
{
namespace
{
/// Finds a step with the exact tangent, or with the projected one.
class Direction
{
public:
  explicit Direction(NewtonProblem &problem)
      : problem(problem)
  {
  }

  /// @return r·d
  double find(const double residual, const double reduction)
  {
    Tangent tangent = residual < exact_below ? Tangent::exact : Tangent::projected;
    try
    {
      return problem.find_step(tangent, reduction);
    }
    catch (const meshes::NotConverged &)
    {
      // Negative curvature. The exact tangent is not tried
      // again before the state has moved far.
      if (tangent == Tangent::exact)
        exact_below = 0.1 * residual;
      return problem.find_step(Tangent::projected, reduction);
    }
  }

private:
  NewtonProblem &problem;
  double exact_below = std::numeric_limits<double>::infinity();
};

/// The energy falls as much as the slope promises; where rounding hides that, the forces decide.
bool is_better(const NewtonState &next, const NewtonState &now, const double promised)
{
  if (next.energy <= now.energy + 1e-4 * promised)
    return true;
  return std::isfinite(next.energy) && next.energy - now.energy <= now.energy_round_off &&
         next.residual < now.residual;
}

bool is_idle(const std::vector<double> &history, const NewtonOptions &options)
{
  const std::size_t n = history.size() - 1;
  return n >= 15 && n >= options.most_idle && history[n] > 0.5 * history[n - options.most_idle];
}
} // namespace

void minimize(NewtonProblem &problem, const NewtonOptions &options)
{
  Direction direction(problem);
  NewtonState now  = problem.state();
  double reduction = options.largest_reduction;
  std::vector<double> history;
  while (true)
  {
    history.push_back(now.residual / (now.size > 0. ? now.size : 1.));
    if (!std::isfinite(now.residual) || !std::isfinite(now.energy))
      throw meshes::NotConverged("Newton's method: the energy or the forces are not finite",
                                 history);
    const std::size_t n = history.size() - 1; // steps
    if (now.residual <= now.least ||
        (n > 2 && now.is_at_round_off && history[n] > 0.5 * history[n - 1]))
      return;
    if (n >= options.most_steps || is_idle(history, options))
      throw meshes::NotConverged("Newton's method stalls", history);

    const double slope = direction.find(now.residual, reduction);
    double length      = 1.;
    NewtonState next   = problem.at(length);
    while (!is_better(next, now, length * slope))
    {
      if (now.is_at_round_off)
        return;
      length *= 0.5;
      if (length < options.shortest_length)
        throw meshes::NotConverged("the line search found no lower energy", history);
      next = problem.at(length);
    }
    const double fell = next.residual / now.residual;
    problem.keep(length, fell);
    // As exact as the next step can use.
    reduction = std::min(options.largest_reduction, std::max(1e-3, 0.9 * fell * fell));
    now       = next;
  }
}
} // namespace homespun::verification
