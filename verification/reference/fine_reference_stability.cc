// SPDX-License-Identifier: MIT
// Whether an equilibrium of a resolved sheet is a minimum of its energy.
#include "meshes/plain/errors.h"
#include "verification/reference/fine_reference_solver.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace homespun::verification
{
using namespace dealii;

namespace
{
constexpr double missed                  = 0.01;
constexpr unsigned int most_mode_changes = 3;

/// How far random forces must be solved for, relative to their size, that a mode of negative
/// curvature is seen. The residual of conjugate gradients is p(A) r, p(0) = 1, and as long as no
/// direction of negative curvature is met all roots of p are positive: the share of a negative mode
/// in the residual never falls below what it is in the forces, g / sqrt(n) of them with g normally
/// distributed. A residual below c / sqrt(n) is reached beside such a mode with a probability below
/// 0.8 c. (Said in the norm of the preconditioner, measured in the Euclidean one.)
double reduction_for(const double n_unknowns)
{
  return missed / std::sqrt(n_unknowns);
}
} // namespace

/// @param mode receives a direction of negative curvature where the state is unstable
Stability FineReference::Solver::examine(const Vector &displacement, const double strain,
                                         ReferenceStep &step, Vector &mode)
{
  Vector forces = solver->owned_vector(), answer = solver->owned_vector();
  const Eigen::Matrix2d mean_gradient = mean_gradient_at(strain);
  step.n_indefinite = evaluate(displacement, mean_gradient, answer, Tangent::exact).n_indefinite;
  if (step.n_indefinite == 0)
    return Stability::every_triangle;
  // The same forces every time, another share on every rank.
  std::mt19937_64 generator(17 + Utilities::MPI::this_mpi_process(discretization.communicator));
  std::normal_distribution<double> normal;
  for (const auto dof : discretization.locally_owned)
    forces(dof) = constraints.is_constrained(dof) ? 0. : normal(generator);
  forces.compress(VectorOperation::insert);
  for (const bool is_last : {false, true})
    try
    {
      const double target = reduction_for(forces.size()) * forces.l2_norm();
      preconditioner.solve(*solver, answer, forces, target, most_linear_iterations);
      return Stability::stable;
    }
    catch (const homogenization::IndefiniteMatrix &found)
    {
      mode = found.direction;
      constraints.distribute(mode);
      return Stability::unstable;
    }
    catch (const meshes::NotConverged &)
    {
      if (is_last)
        break;
      // A preconditioner of this very state, made definite.
      evaluate(displacement, mean_gradient, answer, Tangent::projected);
      preconditioner.build(*solver);
      evaluate(displacement, mean_gradient, answer, Tangent::exact);
    }
  return Stability::unknown;
}

/// Goes along a mode, either way, as far as lowers the energy by more than round-off, at most a
/// tenth of a cell.
bool FineReference::Solver::leave_along(const Vector &mode, Vector &displacement,
                                        const double strain)
{
  const Eigen::Matrix2d mean_gradient = mean_gradient_at(strain);
  Vector residual = solver->owned_vector(), trial = solver->owned_vector();
  const Evaluation here = evaluate(displacement, mean_gradient, residual, Tangent::none);
  const double downhill = mode * residual > 0. ? -1. : 1.;
  double length         = 0.1 * std::sqrt(sheet.lattice.area()) / mode.linfty_norm();
  for (unsigned int k = 0; k < 20; ++k, length *= 0.5)
    for (const double sign : {downhill, -downhill})
    {
      trial = displacement;
      trial.add(sign * length, mode);
      const Evaluation there = evaluate(trial, mean_gradient, residual, Tangent::none);
      if (there.energy < here.energy - 10. * (here.energy_round_off + there.energy_round_off))
      {
        displacement = trial;
        return true;
      }
    }
  return false;
}

Stability FineReference::Solver::stabilize(ReferenceStep &step)
{
  if (law == Law::linear)
    return Stability::every_triangle;
  Vector displacement           = levels.back().displacement, mode;
  const ReferenceStep as_it_was = step;
  for (unsigned int k = 0; k <= most_mode_changes; ++k)
  {
    const Stability found = examine(displacement, step.strain, step, mode);
    if (found != Stability::unstable)
    {
      if (k == 0)
        return found;
      if (found == Stability::unknown)
        break;
      levels.back().displacement = displacement;
      levels.back().free_strains = free_strains;
      step.positions             = positions_of(displacement, step.strain);
      return Stability::left;
    }
    if (k == most_mode_changes || !leave_along(mode, displacement, step.strain))
      break;
    try
    {
      solve_with_sides(displacement, step.strain, options.tolerance, step);
    }
    catch (const meshes::NotConverged &)
    {
      break;
    }
  }
  step         = as_it_was;
  free_strains = levels.back().free_strains;
  return Stability::unstable;
}
} // namespace homespun::verification
