// SPDX-License-Identifier: MIT
// One level of a resolved sheet: what Newton's method asks of it.
#include "verification/newton/newton.h"
#include "verification/reference/field_integrals.h"
#include "verification/reference/fine_reference_solver.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
using namespace dealii;

class FineReference::Solver::Level final : public NewtonProblem
{
public:
  /// @param displacement which carries the prescribed values of the strain
  Level(Solver &of, const double strain, const double tolerance, Vector &displacement,
        ReferenceStep &step)
      : of(of)
      , mean_gradient(of.mean_gradient_at(strain))
      , tolerance(tolerance)
      , displacement(displacement)
      , step(step)
      , residual(of.solver->owned_vector())
      , increment(residual)
      , trial(residual)
      , forces(residual)
      , now(of.evaluate(displacement, mean_gradient, residual, Tangent::none))
  {
  }

  NewtonState state() override
  {
    return summary(now);
  }

  double find_step(const Tangent tangent, const double reduction) override
  {
    forces = residual;
    forces *= -1.;
    const Evaluation assembled = of.evaluate(displacement, mean_gradient, trial, tangent);
    if (tangent == Tangent::exact)
      step.n_indefinite = assembled.n_indefinite;
    const double target = std::max(0.1 * now.least_residual(tolerance), reduction * now.residual);
    step.n_linear +=
      of.preconditioner.solve(*of.solver, increment, forces, target, most_linear_iterations);
    of.constraints.distribute(increment);
    ++step.n_newton;
    return -(forces * increment);
  }

  NewtonState at(const double length) override
  {
    trial = displacement;
    trial.add(length, increment);
    next = of.evaluate(trial, mean_gradient, residual_there, Tangent::none);
    return summary(next);
  }

  void keep(double, double) override
  {
    displacement = trial;
    residual     = residual_there;
    now          = next;
  }

  const Evaluation &evaluation() const
  {
    return now;
  }

private:
  NewtonState summary(const Evaluation &of_state) const
  {
    NewtonState state;
    state.energy = of_state.energy;
    // The step of a linear law ends at the answer, whatever rounding makes of its energy.
    state.energy_round_off = of.law == Law::linear
                               ? std::numeric_limits<double>::infinity()
                               : 1e-13 * std::abs(of_state.energy) + of_state.energy_round_off;
    state.residual         = of_state.residual;
    state.least            = of_state.least_residual(tolerance);
    state.size             = of_state.force_size;
    return state;
  }

  Solver &of;
  const Eigen::Matrix2d mean_gradient;
  const double tolerance;
  Vector &displacement;
  ReferenceStep &step;
  Vector residual, increment, trial, forces, residual_there = residual;
  Evaluation now, next;
};

void FineReference::Solver::take_body_force(const double strain)
{
  if (body_force)
    body_load = load_vector(discretization, constraints,
                            [&](const Eigen::RowVector2d &point)
                            {
                              const Eigen::RowVector2d force = body_force(point, strain);
                              return FieldValue(force(0), force(1), 0.);
                            });
}

/// Newton's method from `displacement`, which carries the prescribed values of this strain.
/// @throws NotConverged
void FineReference::Solver::solve(Vector &displacement, const double strain, const double tolerance,
                                  ReferenceStep &step)
{
  Level level(*this, strain, tolerance, displacement, step);
  NewtonOptions of_newton;
  of_newton.most_steps = most_newton_steps;
  if (law == Law::linear)
    of_newton.largest_reduction = 0.; // one step
  minimize(level, of_newton);
  const Evaluation &found = level.evaluation();
  step.relative_residual  = found.residual / found.force_size;
  step.energy             = found.energy;
  step.forces             = found.forces;
  step.n_inverted         = law == Law::linear ? 0 : found.n_inverted;
  step.is_at_round_off    = found.residual > tolerance * found.force_size;
}
} // namespace homespun::verification
