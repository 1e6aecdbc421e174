// SPDX-License-Identifier: MIT
// Symmetric positive definite systems by sparse Cholesky factorization (CHOLMOD), refined by
// conjugate gradients until round-off: what the fourth-order systems of brackets ask for, where
// multigrid stalls.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>

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

  /// Factors a matrix, scaled to a unit diagonal: then a mesh that is graded towards a corner costs
  /// the factorization no digits.
  /// @param lower_triangle of the matrix
  /// @param what the unknowns are, for messages
  /// @throws NotConverged where the matrix is singular or indefinite beyond round-off
  CholeskySolver(const Eigen::SparseMatrix<double> &lower_triangle, const std::string &what);
  ~CholeskySolver();

  /// Solves for all right-hand sides.
  /// @throws NotConverged with the residual history where the energy does not settle
  Solution solve(const Eigen::MatrixXd &right_hand_sides) const;

private:
  struct Factorization;
  std::string what;
  Eigen::VectorXd scale; ///< 1 / sqrt(diagonal)
  Eigen::SparseMatrix<double> scaled;
  std::unique_ptr<Factorization> factorization;
};
} // namespace homespun::homogenization
