// SPDX-License-Identifier: MIT
// Sparse Cholesky factorisation L L^T of a BlockMatrix, the linear algebra under every step of a
// cloth of up to some ten thousand vertices.
//
// Left-looking by supernodes (Ng & Peyton 1993): consecutive block columns whose rows agree, or
// nearly do, are one dense panel, so that the work is products of dense matrices: what one thread
// reaches stands in the benchmark `factorise`. The structure is laid out once.
#pragma once

#include "shell/algebra/block_matrix.h"

#include <vector>

namespace homespun::shell
{
template <int dim>
class BlockCholeskyOf
{
public:
  /// Lays out L for matrices of this structure.
  explicit BlockCholeskyOf(const BlockMatrixOf<dim> &matrix);

  /// Factors. @return whether the matrix is positive definite to working precision: every pivot
  ///   above 1e-14 of its diagonal entry
  bool factorize(const BlockMatrixOf<dim> &matrix);

  /// Solves for the free rows; held rows of the result are zero.
  void solve(const VectorsOf<dim> &right_side, VectorsOf<dim> &result) const;

  /// Numbers that are stored for L, the zeros of its panels included.
  std::size_t n_entries() const
  {
    return nodes.back().start;
  }
  /// Multiplications and additions of one factorisation, two flops each, number by number: without
  /// those on stored zeros and above diagonals. A division or a root counts as one of them.
  double n_multiply_adds() const
  {
    return multiply_adds;
  }
  std::size_t bytes() const;

private:
  /// Consecutive columns with the same rows: a panel of dim n_rows x dim n_columns numbers, column
  /// by column.
  struct Supernode
  {
    int column;        ///< first of its columns
    int n_columns;     ///<
    int first_row;     ///< in `row`; the first rows are the columns themselves
    int n_rows;        ///<
    std::size_t start; ///< first number in `values`
    int first_update;  ///< in `updates`, up to that of the next supernode
  };
  /// A panel some of whose rows are columns of a later one.
  struct Update
  {
    int source; ///< supernode
    int offset; ///< of the first such row
    int n_rows; ///< how many
  };
  std::vector<int> lay_out_nodes(const std::vector<std::vector<int>> &rows);
  void lay_out_updates(const std::vector<int> &node_of);
  void gather(const BlockMatrixOf<dim> &matrix, const Supernode &node);
  void subtract(const Update &update, const Supernode &node);

  std::vector<int> vertex_at;
  std::vector<Supernode> nodes; ///< and one more at the end
  std::vector<int> row;         ///< places of the rows
  std::vector<Update> updates;  ///< supernode after supernode
  std::vector<double> values;   ///< panels
  double multiply_adds = 0.;
  mutable std::vector<double> work; ///< a product of panels; right sides
  std::vector<int> position;        ///< place of a row in the panel at hand
  std::size_t n_product = 0;        ///< largest product of two panels
};

using BlockCholesky = BlockCholeskyOf<3>;
} // namespace homespun::shell
