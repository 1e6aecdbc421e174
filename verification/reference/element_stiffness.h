// SPDX-License-Identifier: MIT
// The stiffness of an element from the tangent of its law at a point.
#pragma once

#include <Eigen/Core>

namespace homespun::verification
{
/// Of displacements with `dim` components, node after node.
template <int dim, int n_shapes>
using ElementStiffness = Eigen::Matrix<double, dim * n_shapes, dim * n_shapes, Eigen::RowMajor>;

/// Adds weight grad N_i . dP/dF . grad N_j, which is symmetric, for all nodes i and j.
/// @param tangent dP/dF by the entries of F row by row (2 dim, 2 dim)
/// @param slopes grad N (n_shapes,2)
template <int dim, int n_shapes>
void add_stiffness(const Eigen::Matrix<double, 2 * dim, 2 * dim> &tangent,
                   const Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor> &slopes,
                   const double weight, ElementStiffness<dim, n_shapes> &K)
{
  // dP for a motion of each node along each axis; rows that are long are what compilers make
  // vectors of.
  Eigen::Matrix<double, 2 * dim, dim * n_shapes, Eigen::RowMajor> dP;
  for (int j = 0; j < n_shapes; ++j)
    for (int b = 0; b < dim; ++b)
      dP.col(dim * j + b) =
        weight * (tangent.col(2 * b) * slopes(j, 0) + tangent.col(2 * b + 1) * slopes(j, 1));
  for (int i = 0; i < n_shapes; ++i)
    for (int a = 0; a < dim; ++a)
      K.row(dim * i + a) += slopes(i, 0) * dP.row(2 * a) + slopes(i, 1) * dP.row(2 * a + 1);
}
} // namespace homespun::verification
