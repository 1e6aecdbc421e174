// SPDX-License-Identifier: MIT
// Two stiffnesses compared by the energies they give to a macro strain: soft directions count as
// much as stiff ones, whatever the contrast. What is not a number stays one.
#pragma once

#include <Eigen/Core>

namespace homespun::verification
{
/// Largest relative difference of the energies of any macro strain, the largest |eigenvalue| of
/// L^-1 (A − B) L^-T with B = L L^T; not a number where A holds one or B is not positive.
double energy_difference(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B);

/// By how much A <= B fails for the worst macro strain, relative to B; zero where it holds; not a
/// number as above.
double order_violation(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B);
} // namespace homespun::verification
