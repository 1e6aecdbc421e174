// SPDX-License-Identifier: MIT
#include "homogenization/fem/kept_multigrid.h"

#include <algorithm>
#include <cmath>

namespace homespun::homogenization
{
void KeptMultigrid::build(ElasticSolver &solver)
{
  solver.build_preconditioner();
  is_old = false;
}

unsigned int KeptMultigrid::solve(ElasticSolver &solver, ElasticSolver::Vector &increment,
                                  const ElasticSolver::Vector &forces, const double target,
                                  const unsigned int most_iterations)
{
  const bool is_new = is_old || !solver.has_preconditioner();
  if (is_new)
    build(solver);
  // Should this solve fail, the next one has a hierarchy of its own.
  is_old                  = true;
  increment               = 0.;
  const unsigned int used = solver.solve(increment, forces, target, most_iterations);
  // A hierarchy serves until it costs half as much again, per digit gained.
  const double per_digit = (used + 1) / std::max(1., std::log10(forces.l2_norm() / target));
  if (is_new)
    iterations_per_digit_when_new = per_digit;
  is_old = per_digit > 1.5 * iterations_per_digit_when_new;
  return used;
}
} // namespace homespun::homogenization
