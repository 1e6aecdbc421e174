// SPDX-License-Identifier: MIT
// A symmetric positive definite matrix on one rank, factored by CHOLMOD: the preconditioner of
// conjugate gradients that then have a few iterations.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <string>

namespace homespun::homogenization
{
/// A = S^-1 L L^T S^-1 up to round-off, S = 1/sqrt(diagonal of A): scaled like that, stiff and soft
/// phases, and meshes that are graded towards a corner, cost the factorization no digits.
///
/// The order of elimination is found once for matrices with the same places of entries: the last
/// few are remembered, for as long as the program runs. The factor is the same to the last bit.
class CholeskyFactor
{
public:
  /// @param lower_triangle of the matrix
  /// @param what the unknowns are, for messages
  /// @throws NotConverged where the matrix is singular, or indefinite beyond round-off
  CholeskyFactor(Eigen::SparseMatrix<double> lower_triangle, const std::string &what);
  ~CholeskyFactor();

  /// Of another matrix, in the same room where its entries are at the same places.
  /// @throws NotConverged as above; there is no factor then
  void factorize(Eigen::SparseMatrix<double> lower_triangle);

  /// A^-1 of several right-hand sides (n, loads), for which the factor is read once.
  Eigen::MatrixXd solve(const Eigen::MatrixXd &right_hand_sides) const;

private:
  class Decomposition;
  const std::string what;
  Eigen::VectorXd scale; ///< 1 / sqrt(diagonal)
  std::unique_ptr<Decomposition> decomposition;
};
} // namespace homespun::homogenization
