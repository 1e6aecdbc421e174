// SPDX-License-Identifier: MIT
// Eigenvalues of symmetric matrices. Eigen's solver, which takes a compiler as long as a source of
// 500 lines does, compiled here once and not in each source that asks for them.
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

/// Eigenvalues and eigenvectors of a symmetric matrix, by QR iterations.
/// @tparam n 2, 3, 4 or Eigen::Dynamic
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
