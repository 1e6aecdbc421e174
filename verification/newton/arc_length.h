// SPDX-License-Identifier: MIT
// A path of equilibria r(x, s) = 0 followed by its arc length, round limit points, where the
// parameter s turns back and no step in s can go on (Keller 1977; Riks 1979; Crisfield 1981).
//
//   K a = −r,   K b = −dr/ds,        dx = a + ds b,  with  (dx, ds) normal to the tangent (t, t_s)
//
// The method sees numbers alone; vectors and factors are those of a problem.
#pragma once

#include <vector>

namespace homespun::verification
{
/// What is asked of the equations at the present x and s.
struct PathLinearization
{
  double residual = 0.;                ///< |r|
  double least    = 0.;                ///< the residual that counts as none
  double a_t = 0., b_t = 0., b_b = 0.; ///< products of a, b and the tangent t that is kept
  int n_negative = 0;                  ///< negative eigenvalues of K
};

/// Equations and a state that moves.
class PathProblem
{
public:
  virtual ~PathProblem() = default;

  /// Solves for a and b. @throws NotConverged where K is singular to round-off
  virtual PathLinearization linearize() = 0;

  /// x += of_a a + of_b b + of_t t,  s += by.
  virtual void move(double of_a, double of_b, double of_t, double by) = 0;

  /// t = factor b.
  virtual void take_tangent(double factor) = 0;

  /// Keeps the present x, s and t, and comes back to them.
  virtual void mark()           = 0;
  virtual void return_to_mark() = 0;

  virtual double parameter() const = 0;
};

struct PathPoint
{
  double parameter = 0.;
  int n_negative   = 0; ///< negative eigenvalues of K there: 0 where it is a minimum
};

enum class PathEnd
{
  reached, ///< the goal was passed
  turned,  ///< the parameter turned back: a limit point was passed
  lost     ///< the shortest step found no equilibrium, or the steps ran out
};

struct FollowedPath
{
  PathEnd end = PathEnd::lost;
  std::vector<PathPoint> points; ///< in their order, the start first
  double farthest = 0.;          ///< parameter: that of the limit point where there is one
};

/// Follows the path from an equilibrium towards a value of the parameter, and one step beyond a
/// limit point, which is the last point but one.
/// @param first_step of the parameter
FollowedPath follow_path(PathProblem &problem, double goal, double first_step, int most_steps);
} // namespace homespun::verification
