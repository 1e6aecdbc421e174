// SPDX-License-Identifier: MIT
// A symmetric sparse matrix over the free vertices of a mesh, and its LDL^T factorisation: the
// linear algebra under every static or time step of the cloth.
//
// What depends on the connectivity alone is done once: a fill-reducing order of the vertices, the
// sparsity, the place of every element block in it, and the symbolic factorisation. After that a
// step writes values, refactors numerically, and substitutes. The matrix is stored in the order of
// its factorisation, so that nothing is permuted or copied between assembly and factorisation.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <vector>

namespace homespun::shell
{
template <int dim>
class FreeVertexMatrix
{
public:
  using Element = Eigen::Matrix<double, 3 * dim, 3 * dim>;
  using Rows    = Eigen::Matrix<double, Eigen::Dynamic, dim, Eigen::RowMajor>;

  /// Orders the free vertices (approximate minimum degree) and factors symbolically.
  /// @param triangles (m,3) the elements
  /// @param is_held (n) vertices that are no unknowns
  FreeVertexMatrix(const meshes::Triangles &triangles, const std::vector<bool> &is_held);

  /// Sets all values to zero.
  void clear();

  /// Adds an element matrix; component i of corner k is its unknown k dim + i. Rows and columns of
  /// held vertices are dropped.
  void add(int triangle, const Element &element);

  /// Factors matrix + shift * I. @return whether it is positive definite to working precision
  bool factorize(double shift = 0.);

  /// Solves for the free rows; held rows of the result are zero.
  /// @param right_side (n,dim), held rows are ignored
  Rows solve(const Rows &right_side) const;

  /// Matrix times vector over the free rows; held rows of `rows` count as zero.
  Rows multiply(const Rows &rows) const;

  /// Mean of the diagonal, the size by which a shift is measured; zero where all is held.
  double mean_diagonal() const;

  /// Number of unknowns, dim times the number of free vertices.
  int n_unknowns() const;

  /// Number of entries of the factor L, below its diagonal.
  Eigen::Index n_factor_entries() const;

private:
  Eigen::VectorXd gather(const Rows &rows) const;
  Rows scatter(const Eigen::VectorXd &unknowns) const;

  meshes::Triangles triangles;
  std::vector<int> place;            ///< (n) place of a vertex in the order, −1 where held
  std::vector<int> block_row;        ///< (3 m) blocks above that of edge k, k + 1 in its column
  Eigen::SparseMatrix<double> upper; ///< upper half, in the order of the factorisation
  Eigen::VectorXd shifts;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper, Eigen::NaturalOrdering<int>>
    factor;
};
} // namespace homespun::shell
