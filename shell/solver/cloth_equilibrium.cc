// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "shell/solver/cloth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::shell
{
ClothEquilibrium Cloth::solve_equilibrium(const double relative_tolerance, const int max_iterations)
{
  potential.prepare();
  ClothEquilibrium result;
  for (const auto &term : terms())
    term->begin_step({x, v, now, std::numeric_limits<double>::infinity()});
  set_held(x);
  v.setZero();
  stored.reset();

  SolveCounts counts;
  IncrementalPotential::Residual residual = potential.assemble(x, x, 0., Hessian::projected);
  // A step in which a typical edge's stiffness and the inertia weigh the same.
  double stiffest = 0., lightest = m.maxCoeff();
  for (int i = 0; i < static_cast<int>(x.rows()); ++i)
    if (const double stiffness = potential.stiffness_at(i); stiffness > 0.)
    {
      stiffest = std::max(stiffest, stiffness);
      lightest = std::min(lightest, m(i));
    }
  double shift            = stiffest > 0. ? stiffest / lightest : 1.; // 1/h² [1/s²]
  const double first      = shift;
  double energy           = potential.value(x, x, 0.);
  result.residual_history = {residual.norm};
  while (!residual.is_below(relative_tolerance))
  {
    if (result.iterations >= max_iterations || !std::isfinite(residual.norm))
      throw meshes::NotConverged(
        "equilibrium of the cloth; hold more vertices, or start nearer to it",
        result.residual_history);
    // With little shift left the exact Hessian ends quadratically.
    bool solved          = false;
    const Vectors forces = -potential.gradient();
    Vectors step         = Vectors::Zero(x.rows(), 3);
    if (shift < 1e-6 * first)
    {
      potential.assemble(x, x, 0., Hessian::exact);
      solved = potential.solve(forces, step, counts);
    }
    if (!solved)
    {
      potential.assemble(x, x, shift, Hessian::projected);
      step.setZero();
      solved = potential.solve(forces, step, counts);
    }
    ++result.iterations;
    const double slope    = -forces.cwiseProduct(step).sum();
    const double rounding = potential.round_off_of(energy, x, residual);
    double length = 1., next = std::numeric_limits<double>::infinity();
    Vectors trial;
    for (; solved && length > 1e-3; length *= 0.5)
    {
      trial = x + length * step;
      next  = potential.value(trial, x, 0.);
      if (slope >= 0. || next <= energy + 1e-4 * length * slope + rounding)
        break;
    }
    if (!(next <= energy + rounding))
    {
      shift *= 10.;
      residual = potential.assemble(x, x, 0., Hessian::projected);
      continue;
    }
    x      = trial;
    energy = next;
    shift *= length == 1. ? 0.2 : 2.;
    residual = potential.assemble(x, x, 0., Hessian::projected);
    result.residual_history.push_back(residual.norm);
  }
  result.residual = residual.norm;
  return result;
}
} // namespace homespun::shell
