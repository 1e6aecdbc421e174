// SPDX-License-Identifier: MIT
// A sparse matrix of 3 x 3 blocks over the free vertices of a cloth that need not be symmetric, and
// its LU factorisation: the linear algebra under a conserving step. Forces over a step depend on
// both ends of it, so that their derivative by one end is not symmetric, and the Cholesky
// factorisation of the other integrators does not apply.
#pragma once

#include "shell/algebra/block_matrix.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <memory>
#include <vector>

namespace homespun::shell
{
class VertexMatrix
{
public:
  /// @param is_held (n) vertices that are no unknowns: their rows and columns are dropped
  explicit VertexMatrix(const std::vector<bool> &is_held);

  /// Forgets all values. The same blocks are expected in the same order again: the structure is
  /// analysed once.
  void clear();

  void add(int row, int column, const Eigen::Matrix3d &block);

  /// Factors and solves.
  /// @param right_side (n,3), held rows are ignored
  /// @param result (n,3), held rows are zero
  /// @return false where the matrix is singular to working precision
  bool solve(const Vectors &right_side, Vectors &result);

  /// (n) trace of each diagonal block, zero where held [N/m].
  const Eigen::VectorXd &traces() const
  {
    return diagonal;
  }

  /// Bytes of values and indices, without the factors.
  std::size_t bytes() const;

private:
  std::vector<int> place; ///< (n) among the free vertices, −1 where held
  int n_free = 0;
  Eigen::VectorXd diagonal;
  std::vector<Eigen::Triplet<double>> entries;
  std::unique_ptr<Eigen::SparseLU<Eigen::SparseMatrix<double>>> factor; ///< once analysed
};
} // namespace homespun::shell
