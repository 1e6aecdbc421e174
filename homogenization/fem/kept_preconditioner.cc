// SPDX-License-Identifier: MIT
#include "homogenization/fem/kept_preconditioner.h"

#include <algorithm>
#include <cmath>

namespace homespun::homogenization
{
namespace
{
/// A factor serves until it takes more iterations than this: those of a new one, one or two, and
/// what a factorization costs, which is some dozen of them.
constexpr unsigned int most_iterations_of_factor = 12;
/// An old one is given up after so many: in vain they cost about as much as a factorization.
constexpr unsigned int most_iterations_of_old_factor = 3 * most_iterations_of_factor;
} // namespace

void KeptPreconditioner::build(ElasticSolver &solver)
{
  is_old = false;
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
  bool is_new = is_old || !solver.has_preconditioner();
  if (is_new)
    build(solver);
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
    if (is_factor && is_new)
      throw;
    if (is_factor)
    {
      build(solver);
      is_old = true;
    }
    else
    {
      solver.factorize();
      is_factor = true;
    }
    is_new    = true;
    increment = 0.;
    used      = solver.solve(increment, forces, {target}, most_iterations);
  }
  // A hierarchy serves until it costs half as much again, per digit gained.
  const double per_digit = (used + 1) / std::max(1., std::log10(forces.l2_norm() / target));
  if (is_new)
    iterations_per_digit_when_new = per_digit;
  is_old =
    is_factor ? used > most_iterations_of_factor : per_digit > 1.5 * iterations_per_digit_when_new;
  return used;
}
} // namespace homespun::homogenization
