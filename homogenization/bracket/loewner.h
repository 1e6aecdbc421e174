// SPDX-License-Identifier: MIT
// Stiffnesses as quadratic forms: A <= B where v.A.v <= v.B.v for every strain v. Sides of a
// bracket are such forms, and what round-off takes from them is counted against each energy: soft
// directions count as much as stiff ones, so that its size is the machine's times the condition of
// the form.
#pragma once

#include <Eigen/Core>

namespace homespun::homogenization
{
/// 1 over the smallest eigenvalue of D A D, D_ii = A_ii^-1/2: an error of part x sqrt(A_ii A_jj) in
/// the entries of A is one of at most 3 x part x this in any v.A.v. Units do not count. Infinite
/// where A is not positive.
double weakness(const Eigen::Matrix3d &A);

/// The largest |error_ij| / sqrt(A_ii A_jj): of errors of the entries of A, the part of `weakness`.
double relative_error(const Eigen::Matrix3d &error, const Eigen::Matrix3d &A);

/// A matrix whose entries may be wrong by part x sqrt(A_ii A_jj) lies below this one: A + 3 part
/// diag(A).
Eigen::Matrix3d raised(const Eigen::Matrix3d &A, double part);

/// (1 − round_off) A^-1 <= value <= (1 + round_off) A^-1.
struct RoundedInverse
{
  Eigen::Matrix3d value; ///< symmetric
  double round_off;
};

/// A^-1 = D (L L^T)^-1 D by the Cholesky factors of D A D. Cofactors lose the soft directions of
/// A^-1 to the rounding of the stiff ones; factors keep them up to round-off x weakness(A).
/// @throws NotConverged where A is not positive beyond round-off
/// Source: N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, sections 10.1 and
/// 14.2.
RoundedInverse inverse_of(const Eigen::Matrix3d &A);

/// By how much lower <= upper holds: the largest v.(upper − lower).v / v.upper.v.
/// @param round_off of both
/// @throws std::logic_error where lower lies above upper in any direction by more than round-off,
///   or where either is not a number: two sides of one stiffness cannot
double relative_width(const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper, double round_off);
} // namespace homespun::homogenization
