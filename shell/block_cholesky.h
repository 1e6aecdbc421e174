// SPDX-License-Identifier: MIT
// Sparse Cholesky factorisation L L^T of a BlockMatrix, the linear algebra under every step of a cloth of
// up to some ten thousand vertices.
//
// Left-looking by block columns. The block columns of L are dense panels of three columns over the rows
// that they hold, so that the inner loop is an update of consecutive numbers by a 3 x 3 matrix: at 441
// vertices 2.5 times as fast as a factorisation by scalars (benchmark `factorise`). The structure is laid
// out once.
#pragma once

#include "shell/block_matrix.h"

#include <vector>

namespace homespun::shell
{
class BlockCholesky
{
public:
  /// Lays out L for matrices of this structure.
  explicit BlockCholesky(const BlockMatrix &matrix);

  /// Factors. @return whether the matrix is positive definite to working precision: every pivot above
  ///   1e-14 of its diagonal entry
  bool factorize(const BlockMatrix &matrix);

  /// Solves for the free rows; held rows of the result are zero.
  void solve(const Vectors &right_side, Vectors &result) const;

  /// Numbers in L.
  std::size_t n_entries() const
  {
    return values.size();
  }
  /// Multiplications and additions of one factorisation, two flops each.
  double n_multiply_adds() const
  {
    return multiply_adds;
  }
  std::size_t bytes() const;

private:
  std::vector<int> vertex_at;
  std::vector<int> first;           ///< (n + 1) first row of each column's panel, in `row`
  std::vector<int> row;             ///< places of the rows, the diagonal's first
  std::vector<std::size_t> start;   ///< (n + 1) first number of each panel: 3 columns of 3 (rows) each
  std::vector<double> values;       ///< panels, column after column
  std::vector<int> update_first;    ///< (n + 1) columns that update each column
  std::vector<int> update_column;   ///< their index
  std::vector<int> update_offset;   ///< which of their rows is this column's diagonal
  double multiply_adds = 0.;
  mutable std::vector<double> work; ///< a panel of an update; right sides
  std::vector<int> position;        ///< place of a row in the panel at hand
};
} // namespace homespun::shell
