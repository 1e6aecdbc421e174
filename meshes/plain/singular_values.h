// SPDX-License-Identifier: MIT
// Singular values of matrices of any size. Eigen's decomposition takes a compiler as long as ten
// sources do: it is compiled here once.
#pragma once

#include <Eigen/Core>

namespace homespun::meshes
{
/// A = U S V^T.
struct SingularValues
{
  Eigen::VectorXd values; ///< descending
  Eigen::MatrixXd U, V;   ///< in columns; empty where not asked for
};

/// @param options Eigen's, for example Eigen::ComputeThinU | Eigen::ComputeThinV
SingularValues singular_values(const Eigen::MatrixXd &A, unsigned int options);

/// The shortest x of those with the least |A x − b|, column by column.
/// @param threshold singular values below this part of the largest count as zero
Eigen::MatrixXd least_squares(const Eigen::MatrixXd &A, const Eigen::MatrixXd &b, double threshold);
} // namespace homespun::meshes
