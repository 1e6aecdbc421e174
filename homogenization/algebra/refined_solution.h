// SPDX-License-Identifier: MIT
// Symmetric positive definite systems by sparse Cholesky factorization (CHOLMOD), refined by
// conjugate gradients until round-off: what the fourth-order systems of brackets ask for, where
// multigrid stalls.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <string>

namespace homespun::homogenization
{
struct RefinedSolution
{
  Eigen::MatrixXd values;   ///< (n, loads)
  double excess       = 0.; ///< how far the energy of any of them lies above its minimum, relative
  unsigned iterations = 0;  ///< of the conjugate gradients, the largest of all loads
};

/// Solves for all right-hand sides (n, loads).
/// @param what the unknowns are, for messages
/// @throws NotConverged as CholeskyFactor does, and with the residual history where the energy does
///   not settle
RefinedSolution refined_solution(const Eigen::SparseMatrix<double> &lower_triangle,
                                 const Eigen::MatrixXd &right_hand_sides, const std::string &what);
} // namespace homespun::homogenization
