// SPDX-License-Identifier: MIT
// One step, or an equilibrium, of the resolved cloth: what Newton's method asks of it.
#include "verification/newton/newton.h"
#include "verification/reference/cloth_reference_solver.h"

#include <algorithm>

namespace homespun::verification
{
namespace
{
constexpr unsigned int most_linear_iterations = 300;
} // namespace

class ClothReference::Solver::Minimum final : public NewtonProblem
{
public:
  /// @param positions in which the held nodes are where they belong
  /// @param tension of the continuation at its begin [N/m], 0 for none
  Minimum(Solver &of, const Inertia &inertia, const double tension, Vector &positions,
          ClothStep &step)
      : of(of)
      , inertia(inertia)
      , tension(tension)
      , positions(positions)
      , step(step)
      , residual(of.solver->owned_vector())
      , increment(residual)
      , forces(residual)
      , residual_there(residual)
      , trial(positions)
      , now(of.evaluate(positions, inertia, residual, Tangent::none, 0.))
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
    of.evaluate(positions, inertia, residual_there, tangent, tension);
    const double target = std::max(0.1 * least(now), reduction * now.residual);
    step.n_linear +=
      of.preconditioner.solve(*of.solver, increment, forces, target, most_linear_iterations);
    ++step.n_newton;
    step.n_projected += tangent == Tangent::projected;
    return -(forces * increment);
  }

  NewtonState at(const double length) override
  {
    trial = positions;
    trial.add(length, increment);
    next = of.evaluate(trial, inertia, residual_there, Tangent::none, 0.);
    return summary(next);
  }

  void keep(const double length, const double fell) override
  {
    positions = trial;
    residual  = residual_there;
    now       = next;
    if (length == 1.)
      tension *= std::min(2., std::max(0.02, fell));
  }

  double relative_residual() const
  {
    return now.residual / (now.force_size > 0. ? now.force_size : 1.);
  }

private:
  /// A cloth without loads has forces from rounding only.
  double least(const Evaluation &of_state) const
  {
    return std::max(of.options.tolerance * of_state.force_size, of_state.round_off);
  }

  NewtonState summary(const Evaluation &of_state) const
  {
    NewtonState state;
    state.energy           = of_state.energy;
    state.energy_round_off = 1e-12 * of_state.energy_size;
    state.residual         = of_state.residual;
    state.least            = least(of_state);
    state.size             = of_state.force_size;
    return state;
  }

  Solver &of;
  const Inertia &inertia;
  double tension;
  Vector &positions;
  ClothStep &step;
  Vector residual, increment, forces, residual_there, trial;
  Evaluation now, next;
};

/// Newton's method from `positions`, in which the held nodes are where they belong.
/// @param tension of the continuation at its begin [N/m], 0 for none
/// @throws NotConverged
void ClothReference::Solver::minimize(Vector &positions, const Inertia &inertia,
                                      const double tension, ClothStep &step)
{
  load_origin = positions;
  Minimum minimum(*this, inertia, tension, positions, step);
  NewtonOptions of_newton;
  of_newton.most_steps      = tension > 0. ? 200 : 60;
  of_newton.most_idle       = of_newton.most_steps; // the tension may hold the residual up for long
  of_newton.shortest_length = 1e-4;
  verification::minimize(minimum, of_newton);
  step.relative_residual = minimum.relative_residual();
}
} // namespace homespun::verification
