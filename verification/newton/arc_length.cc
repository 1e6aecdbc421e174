// SPDX-License-Identifier: MIT
#include "verification/newton/arc_length.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace homespun::verification
{
namespace
{
constexpr int most_corrections = 10;

/// Follows a path whose states are measured so that at the start x and s count alike.
class Follower
{
public:
  Follower(PathProblem &problem, const double goal)
      : problem(problem)
      , forwards(goal > problem.parameter() ? 1. : -1.)
  {
    const PathLinearization start = problem.linearize();
    scale                         = start.b_b > 0. ? start.b_b : 1.;
    take_tangent(start, forwards);
    n_negative = start.n_negative;
  }

  /// One step of an arc length.
  /// @return the corrections that it took, nothing where there is no equilibrium
  std::optional<int> step(const double arc)
  {
    problem.mark();
    before = {tangent, n_negative};
    try
    {
      problem.move(0., 0., arc, arc * tangent);
      for (int k = 0; k < most_corrections; ++k)
      {
        const PathLinearization here = problem.linearize();
        const double along           = here.b_t / scale + tangent;
        if (here.residual <= here.least)
        {
          n_negative = here.n_negative;
          take_tangent(here, along > 0. ? 1. : -1.);
          return k;
        }
        const double by = -here.a_t / scale / along;
        if (!std::isfinite(by))
          break;
        problem.move(1., by, 0., by);
      }
    }
    catch (const meshes::NotConverged &)
    {
    }
    back();
    return {};
  }

  /// To where the last step began.
  void back()
  {
    problem.return_to_mark();
    tangent    = before.tangent;
    n_negative = before.n_negative;
  }

  double tangent_now() const
  {
    return tangent;
  }

  /// Where the last step began.
  double tangent_before() const
  {
    return before.tangent;
  }

  /// Whether the parameter turns back along the tangent.
  bool has_turned() const
  {
    return tangent * forwards < 0.;
  }

  double arc_of(const double step) const
  {
    return std::abs(step / tangent);
  }

  PathPoint here() const
  {
    return {problem.parameter(), n_negative};
  }

private:
  /// The tangent (b, 1) of length one, that goes on in the same sense.
  void take_tangent(const PathLinearization &at, const double sense)
  {
    tangent = sense / std::sqrt(1. + at.b_b / scale);
    problem.take_tangent(tangent);
  }

  PathProblem &problem;
  const double forwards;
  double scale   = 1.;
  double tangent = 0.; ///< t_s
  int n_negative = 0;
  struct
  {
    double tangent = 0.;
    int n_negative = 0;
  } before;
};

/// Goes from a point before a limit point to the limit point itself, where the tangent is normal to
/// the parameter: regula falsi (Illinois) over the arc length from there.
/// @param arc that ends behind it
void go_to_limit_point(Follower &follower, const double arc)
{
  double near = 0., far = arc, at_near = follower.tangent_before(), at_far = follower.tangent_now();
  for (int k = 0; k < 40 && std::abs(follower.tangent_now()) > 1e-7; ++k)
  {
    follower.back();
    const double middle = near + (far - near) * at_near / (at_near - at_far);
    if (!follower.step(middle))
      return;
    const double now = follower.tangent_now();
    if (now * at_far > 0.)
    {
      far    = middle;
      at_far = now;
      at_near *= 0.5;
    }
    else
    {
      near    = middle;
      at_near = now;
      at_far *= 0.5;
    }
  }
}
} // namespace

FollowedPath follow_path(PathProblem &problem, const double goal, const double first_step,
                         const int most_steps)
{
  FollowedPath path;
  Follower follower(problem, goal);
  const double forwards = goal > problem.parameter() ? 1. : -1.;
  double arc            = follower.arc_of(first_step);
  const double shortest = 1e-4 * arc;
  path.points.push_back(follower.here());
  path.farthest = problem.parameter();
  for (int k = 0; k < most_steps && arc >= shortest;)
  {
    const std::optional<int> corrections = follower.step(arc);
    if (!corrections)
    {
      arc *= 0.5;
      continue;
    }
    ++k;
    if (follower.has_turned())
    {
      go_to_limit_point(follower, arc);
      path.points.push_back(follower.here());
      path.farthest = problem.parameter();
      if (follower.step(arc))
      {
        path.points.push_back(follower.here());
        path.end = PathEnd::turned;
      }
      return path;
    }
    path.points.push_back(follower.here());
    path.farthest = problem.parameter();
    if ((path.farthest - goal) * forwards >= 0.)
    {
      path.end = PathEnd::reached;
      return path;
    }
    if (*corrections <= 3)
      arc *= 1.5;
  }
  return path;
}
} // namespace homespun::verification
