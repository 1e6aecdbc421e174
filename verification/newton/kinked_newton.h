// SPDX-License-Identifier: MIT
// Newton's method on an energy with kinks in its gradient, that resists some motions not at all:
// a cloth that wrinkles. Where a triangle begins to wrinkle its tangent jumps, so that full steps
// may go to and fro between two sides of a kink for ever, and slack triangles leave the tangent
// singular.
//
//   (K(x) + times K_1) d = −r(x),   x <- x + length d,
//   length: |r(x + length d)·d| <= ½ |r(x)·d|, or all of d where the energy still falls at its end
//
// K is the projected tangent at x, K_1 what makes it regular. It is taken a fifth as often after
// each whole step, so that the steps end quadratically, and more where a kink has cut one short
// (Li, Fukushima, Qi, Yamashita, Comput. Optim. Appl. 28, 2004, regularize so). The residual knows
// nothing of it: what is found is an equilibrium of the energy itself. Where that leaves positions
// open, the way decides which of them is found.
#pragma once

#include "verification/newton/newton.h"

namespace homespun::verification
{
/// A problem whose matrix can be made regular, and whose states know their slope.
class KinkedProblem : public NewtonProblem
{
public:
  /// Takes K_1 so many times into the matrices of the steps that follow.
  virtual void steady(double times) = 0;

  /// r(x + length d)·d of the state that was asked for last.
  virtual double slope_there() const = 0;
};

/// Minimises from the state that the problem keeps, in which the answer stands afterwards.
/// @throws NotConverged with the history of residual / size
void minimize_with_kinks(KinkedProblem &problem, const NewtonOptions &options);
} // namespace homespun::verification
