// SPDX-License-Identifier: MIT
// A symmetric sparse matrix over the free vertices of a sheet in its plane, and its factorisation:
// the linear algebra under a static solve.
#pragma once

#include "shell/algebra/block_cholesky.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::shell
{
class PlaneMatrix
{
public:
  /// The vertices of each element (m,k).
  using Elements = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Rows     = VectorsOf<2>;

  /// Orders the free vertices and factors symbolically.
  /// @param elements whose vertices are coupled with each other
  /// @param is_held (n) vertices that are no unknowns
  PlaneMatrix(const Elements &elements, const std::vector<bool> &is_held);

  /// Sets all values to zero.
  void clear();

  /// Adds an element matrix (2k,2k); component i of its vertex a is its unknown 2 a + i. Rows and
  /// columns of held vertices are dropped.
  template <typename Values>
  void add(const int element, const Eigen::MatrixBase<Values> &values)
  {
    auto place = places.begin() + element * n_pairs();
    for (int a = 0; a < n_vertices; ++a)
      for (int b = a; b < n_vertices; ++b)
        matrix.add(*place++, values.template block<2, 2>(2 * a, 2 * b));
  }

  /// Factors matrix + shift * I. @return whether it is positive definite to working precision
  bool factorize(double shift = 0.);

  /// Solves for the free rows; held rows of the result are zero.
  /// @param right_side (n,2), held rows are ignored
  Rows solve(const Rows &right_side) const;

  /// Matrix times vector over the free rows; held rows of `rows` count as zero.
  Rows multiply(const Rows &rows) const;

  /// Mean of the diagonal, the size by which a shift is measured; zero where all is held.
  double mean_diagonal() const;

private:
  int n_pairs() const
  {
    return n_vertices * (n_vertices + 1) / 2;
  }

  int n_vertices; ///< of an element
  BlockMatrixOf<2> matrix;
  BlockCholeskyOf<2> cholesky;
  std::vector<BlockMatrixOf<2>::Slot> places; ///< of the pairs of each element
  double shifted = 0.;                        ///< what is on the diagonal by now
};
} // namespace homespun::shell
