// SPDX-License-Identifier: MIT
// Newton's method on an energy, as all references use it: the sheet in the plane, the cloth in
// space, the periodic cell. The method sees numbers alone; vectors, element loops and linear
// solvers are those of a problem, which hands in its residual, its tangent and its steps.
//
//   K(x) d = −r(x),   x <- x + length d,   length = 1, 1/2, 1/4, ... until the energy falls
//
// K is the exact tangent, whose steps end quadratically; where it is not positive definite, the
// projected one, whose steps go downhill. How exact a step has to be is choice 2 of Eisenstat and
// Walker, SIAM J. Sci. Comput. 17, 1996.
#pragma once

#include "verification/newton/tangent.h"

namespace homespun::verification
{
/// What Newton's method has to know of a state.
struct NewtonState
{
  double energy = 0.; ///< what is minimised; infinite where there is no state
  /// What rounding may do to it: a change of no more than this is judged by the residual. Infinite
  /// where the energy says nothing.
  double energy_round_off = 0.;
  double residual         = 0.; ///< norm of what the forces leave
  double least            = 0.; ///< the residual that counts as none
  double size             = 1.; ///< of the forces before they cancel, in the unit of the residual
  /// Whether a residual like this one counts as none where a step no longer halves it.
  bool is_at_round_off = false;
};

/// An energy of a state that the problem keeps, and a step from it.
class NewtonProblem
{
public:
  virtual ~NewtonProblem() = default;

  /// The state that is kept.
  virtual NewtonState state() = 0;

  /// Finds the step d from it.
  /// @param reduction what the residual of K d = −r may be, as a part of |r|
  /// @return r·d, negative
  /// @throws NotConverged where K is not positive definite or the linear solver does not end
  virtual double find_step(Tangent tangent, double reduction) = 0;

  /// The state at x + length d.
  virtual NewtonState at(double length) = 0;

  /// Keeps the state that was asked for last.
  /// @param length of the step to it
  /// @param fell its residual as a part of the one before
  virtual void keep(double length, double fell) = 0;
};

struct NewtonOptions
{
  unsigned int most_steps  = 30;
  unsigned int most_idle   = 10;   ///< steps, after 15, in which the residual has to halve
  double largest_reduction = 0.01; ///< see NewtonProblem::find_step()
  double shortest_length   = 1e-3; ///< of a step in parts of Newton's own
};

/// Minimises from the state that the problem keeps, in which the answer stands afterwards.
/// @throws NotConverged with the history of residual / size
void minimize(NewtonProblem &problem, const NewtonOptions &options);
} // namespace homespun::verification
