// SPDX-License-Identifier: MIT
// Conjugate gradients with the preconditioner of an earlier matrix, as long as that serves: a
// Cholesky factor on one rank where ElasticSolver::is_small(), else a multigrid hierarchy; where
// conjugate gradients with that fail, a factor takes over. A factor is made anew where that lowers
// the mean cost of a solve.
#pragma once

#include "homogenization/fem/elastic_solver.h"

namespace homespun::homogenization
{
class KeptPreconditioner
{
public:
  /// Solves with the matrix of `solver` as it is, from zero.
  /// @param target of |forces − K increment|
  /// @return iterations
  /// @throws NotConverged; the next call makes a preconditioner of its own
  unsigned int solve(ElasticSolver &solver, ElasticSolver::Vector &increment,
                     const ElasticSolver::Vector &forces, double target,
                     unsigned int most_iterations);

  /// Makes one of the present matrix, which the next solve uses whatever it takes; of a matrix that
  /// is not positive definite a hierarchy, with which conjugate gradients tell the direction.
  void build(ElasticSolver &solver);

private:
  bool is_old = false, is_factor = false;
  bool is_fresh         = false;               ///< no solve has used it
  unsigned int n_solves = 0, n_iterations = 0; ///< with it, and what its making cost
  double iterations_per_digit_when_new = 0.;
};
} // namespace homespun::homogenization
