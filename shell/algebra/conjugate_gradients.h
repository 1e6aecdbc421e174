// SPDX-License-Identifier: MIT
// Preconditioned conjugate gradients on a BlockMatrix, for cloths whose factorisation would not
// pay.
#pragma once

#include "shell/algebra/block_matrix.h"

#include <vector>

namespace homespun::shell
{
/// Incomplete Cholesky factorisation on the blocks of the matrix itself, without fill (Meijerink &
/// van der Vorst 1977). A pivot block that loses its sign is replaced by the matrix's own diagonal
/// block.
class IncompleteCholesky
{
public:
  /// Lays out the work space for matrices of this structure.
  explicit IncompleteCholesky(const BlockMatrix &matrix);

  void factorize(const BlockMatrix &matrix);

  /// z = (L L^T)^-1 r over the free vertices; held rows of z are zero.
  void apply(const BlockMatrix &matrix, const Vectors &r, Vectors &z) const;

  std::size_t bytes() const;

private:
  std::vector<BlockMatrix::Block> values;   ///< L below the diagonal
  std::vector<BlockMatrix::Block> inverses; ///< of L's diagonal blocks
};

struct ConjugateGradientsReport
{
  int iterations           = 0;
  double relative_residual = 0.; ///< |r| / |right side|
};

/// Solves A x = b from the given x.
/// @param x (n,3) first guess, overwritten; held rows are zero
/// @throws NotConverged with the history of the relative residual
ConjugateGradientsReport conjugate_gradients(const BlockMatrix &matrix,
                                             const IncompleteCholesky &preconditioner,
                                             const Vectors &right_side, double relative_tolerance,
                                             int max_iterations, Vectors &x);
} // namespace homespun::shell
