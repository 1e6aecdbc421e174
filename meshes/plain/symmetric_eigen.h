// SPDX-License-Identifier: MIT
// Eigenvalues of small symmetric matrices. Eigen's solver, compiled here once and not in each
// source that asks for them.
#pragma once

#include <Eigen/Core>

namespace homespun::meshes
{
template <int n>
struct SymmetricEigen
{
  Eigen::Matrix<double, n, 1> values;  ///< ascending
  Eigen::Matrix<double, n, n> vectors; ///< in columns, of length 1
};

/// Eigenvalues and eigenvectors of a symmetric matrix of 2, 3 or 4 rows, by QR iterations.
/// @param A whose lower triangle is read
template <int n>
SymmetricEigen<n> symmetric_eigen(const Eigen::Matrix<double, n, n> &A);

/// A symmetric matrix without its negative eigenvalues: itself where it has none, or is not finite.
template <int n>
Eigen::Matrix<double, n, n> positive_part(const Eigen::Matrix<double, n, n> &A)
{
  if (!A.allFinite())
    return A;
  const SymmetricEigen<n> eigen = symmetric_eigen<n>(A);
  if (eigen.values(0) >= 0.)
    return A;
  return eigen.vectors * eigen.values.cwiseMax(0.).asDiagonal() * eigen.vectors.transpose();
}
} // namespace homespun::meshes
