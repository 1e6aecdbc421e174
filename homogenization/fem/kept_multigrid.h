// SPDX-License-Identifier: MIT
// Conjugate gradients with the multigrid hierarchy of an earlier matrix, as long as that serves.
#pragma once

#include "homogenization/fem/elastic_solver.h"

namespace homespun::homogenization
{
class KeptMultigrid
{
public:
  /// Solves with the matrix of `solver` as it is, from zero.
  /// @param target of |forces − K increment|
  /// @return iterations
  /// @throws NotConverged; the next call makes a hierarchy of its own
  unsigned int solve(ElasticSolver &solver, ElasticSolver::Vector &increment,
                     const ElasticSolver::Vector &forces, double target,
                     unsigned int most_iterations);

  /// Makes a hierarchy of the present matrix.
  void build(ElasticSolver &solver);

private:
  bool is_old                          = false;
  double iterations_per_digit_when_new = 0.;
};
} // namespace homespun::homogenization
