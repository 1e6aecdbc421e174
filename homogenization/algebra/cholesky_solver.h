// SPDX-License-Identifier: MIT
// Symmetric positive definite systems by sparse Cholesky factorization (CHOLMOD), refined by
// conjugate gradients until round-off: what the fourth-order systems of brackets ask for, where
// multigrid stalls.
#pragma once

#include "homogenization/algebra/cholesky_factor.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <string>

namespace homespun::homogenization
{
class CholeskySolver
{
public:
  struct Solution
  {
    Eigen::MatrixXd values;  ///< (n, loads)
    double excess = 0.;      ///< how far the energy of any of them lies above its minimum, relative
    unsigned iterations = 0; ///< of the conjugate gradients, the largest of all loads
  };

  /// @param lower_triangle of the matrix
  /// @param what the unknowns are, for messages
  /// @throws as CholeskyFactor
  CholeskySolver(const Eigen::SparseMatrix<double> &lower_triangle, const std::string &what);

  /// Solves for all right-hand sides.
  /// @throws NotConverged with the residual history where the energy does not settle
  Solution solve(const Eigen::MatrixXd &right_hand_sides) const;

private:
  std::string what;
  Eigen::SparseMatrix<double> matrix; ///< its lower triangle
  CholeskyFactor factor;
};
} // namespace homespun::homogenization
