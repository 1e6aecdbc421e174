// SPDX-License-Identifier: MIT
#include "homogenization/fem/kept_preconditioner.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homespun::homogenization
{
namespace
{
/// What a factorization in the order and room of the last one costs, in iterations with the factor:
/// 7 to 9 were measured on sheets of 12,000 to 290,000 DoFs.
constexpr unsigned int iterations_of_a_factorization = 8;
/// An old factor is given up after so many.
constexpr unsigned int most_iterations_of_old_factor = 3 * iterations_of_a_factorization;
} // namespace

void KeptPreconditioner::build(ElasticSolver &solver)
{
  is_old       = false;
  is_fresh     = true;
  n_solves     = 0;
  n_iterations = iterations_of_a_factorization;
  // On several ranks a hierarchy is kept, which tells directions of negative curvature.
  is_factor = solver.is_small() && solver.n_ranks() == 1;
  if (is_factor)
    try
    {
      return solver.factorize();
    }
    catch (const meshes::NotConverged &)
    {
      is_factor = false;
    }
  solver.build_preconditioner();
}

unsigned int KeptPreconditioner::solve(ElasticSolver &solver, ElasticSolver::Vector &increment,
                                       const ElasticSolver::Vector &forces, const double target,
                                       const unsigned int most_iterations)
{
  if (is_old || !solver.has_preconditioner())
    build(solver);
  const bool is_new = std::exchange(is_fresh, false);
  // Should this solve fail, the next one has a preconditioner of its own.
  is_old            = true;
  increment         = 0.;
  unsigned int used = 0;
  try
  {
    used =
      solver.solve(increment, forces, {target},
                   is_factor && !is_new ? std::min(most_iterations, most_iterations_of_old_factor)
                                        : most_iterations);
  }
  catch (const IndefiniteMatrix &)
  {
    throw;
  }
  catch (const meshes::NotConverged &)
  {
    if (is_factor && !is_new)
      return solve(solver, increment, forces, target, most_iterations);
    if (is_factor)
      throw;
    solver.factorize();
    is_factor = true;
    increment = 0.;
    used      = solver.solve(increment, forces, {target}, most_iterations);
  }
  // A hierarchy serves until it costs half as much again, per digit gained.
  const double per_digit = (used + 1) / std::max(1., std::log10(forces.l2_norm() / target));
  if (is_new)
    iterations_per_digit_when_new = per_digit;
  n_iterations += used;
  ++n_solves;
  // A factor serves until a solve costs more than the mean of all that it has served, its making
  // included: from there on the mean would grow.
  is_old =
    is_factor ? used * n_solves > n_iterations : per_digit > 1.5 * iterations_per_digit_when_new;
  return used;
}
} // namespace homespun::homogenization
