// SPDX-License-Identifier: MIT
// How one step, or an equilibrium, of the resolved cloth is solved: Newton's method with line
// search, inexact linear solves, a multigrid hierarchy that is kept.
#include "meshes/plain/errors.h"
#include "verification/reference/cloth_reference_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr unsigned int most_linear_iterations = 300;
} // namespace

bool ClothReference::Solver::Evaluation::is_converged(const double tolerance) const
{
  // A cloth without loads has forces from rounding only.
  return residual <= std::max(tolerance * force_size, round_off);
}

/// Conjugate gradients with the multigrid hierarchy of an earlier matrix, as long as that serves.
void ClothReference::Solver::solve_linearized(Vector &increment, const Vector &forces,
                                              const double target, ClothStep &step)
{
  const bool is_new = preconditioner_is_old || !solver->has_preconditioner();
  if (is_new)
    solver->build_preconditioner();
  // Should this solve fail, the next one has a hierarchy of its own.
  preconditioner_is_old = true;
  increment             = 0.;
  unsigned int used     = 0;
  try
  {
    used = solver->solve(increment, forces, target, most_linear_iterations);
  }
  catch (const meshes::NotConverged &failure)
  {
    step.n_linear += static_cast<unsigned int>(failure.residual_history().size());
    throw;
  }
  step.n_linear += used;
  const double digits    = std::max(0.5, std::log10(forces.l2_norm() / target));
  const double per_digit = (used + 1) / digits;
  if (is_new)
    iterations_per_digit_when_new = per_digit;
  preconditioner_is_old = per_digit > 1.5 * iterations_per_digit_when_new;
}

/// Newton's method from `positions`, in which the held nodes are where they belong.
/// @param tension of the continuation at its begin [N/m], 0 for none
/// @throws NotConverged
void ClothReference::Solver::minimize(Vector &positions, const Inertia &inertia, double tension,
                                      ClothStep &step)
{
  Vector residual = solver->owned_vector(), increment = solver->owned_vector();
  Vector trial = positions, unused = solver->owned_vector();
  load_origin      = positions;
  Evaluation state = evaluate(positions, inertia, residual, Tangent::none, 0.);
  std::vector<double> history;
  // Looser ones leave the soft motion along the normal, whose forces are small, to the next step.
  constexpr double largest_forcing = 0.01;
  double exact_below               = std::numeric_limits<double>::infinity();
  double forcing                   = largest_forcing;
  const unsigned int most_steps    = tension > 0. ? 200 : 60;
  while (true)
  {
    history.push_back(state.residual / (state.force_size > 0. ? state.force_size : 1.));
    step.relative_residual = history.back();
    if (!std::isfinite(state.residual) || !std::isfinite(state.energy))
      throw meshes::NotConverged("the forces are not finite", history);
    if (state.is_converged(options.tolerance))
      return;
    if (history.size() > most_steps)
      throw meshes::NotConverged(
        "Newton's method did not converge in " + std::to_string(most_steps) + " steps", history);

    const double target =
      std::max(0.3 * std::max(options.tolerance * state.force_size, state.round_off),
               forcing * state.residual);
    residual *= -1.;
    const Vector forces = residual;
    Tangent tangent     = state.residual < exact_below ? Tangent::exact : Tangent::projected;
    for (unsigned int attempt = 0;; ++attempt)
      try
      {
        evaluate(positions, inertia, unused, tangent, tension);
        solve_linearized(increment, forces, target, step);
        break;
      }
      catch (const meshes::NotConverged &)
      {
        if (attempt == 2)
          throw;
        // Negative curvature, or a hierarchy too old.
        if (tangent == Tangent::exact)
          exact_below = 0.1 * state.residual;
        tangent = Tangent::projected;
      }
    ++step.n_newton;
    step.n_projected += tangent == Tangent::projected;

    const double slope = -(forces * increment);
    double length      = 1.;
    Evaluation next;
    while (true)
    {
      trial = positions;
      trial.add(length, increment);
      next = evaluate(trial, inertia, residual, Tangent::none, 0.);
      if (next.energy <= state.energy + 1e-4 * length * slope)
        break;
      // Below the rounding of the energy the forces decide.
      if (std::abs(next.energy - state.energy) <= 1e-12 * next.energy_size &&
          next.residual < state.residual)
        break;
      length *= 0.5;
      if (length < 1e-4)
        throw meshes::NotConverged("the line search found no lower energy", history);
    }
    positions         = trial;
    const double fell = next.residual / state.residual;
    // As exact as the next step of Newton's method can use (Eisenstat and Walker 1996, choice 2).
    forcing = std::min(largest_forcing, std::max(1e-3, 0.9 * fell * fell));
    if (length == 1.)
      tension *= std::min(2., std::max(0.02, fell));
    state = next;
  }
}
} // namespace homespun::verification
