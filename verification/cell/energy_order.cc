// SPDX-License-Identifier: MIT
#include "verification/cell/energy_order.h"

#include "meshes/plain/symmetric_eigen.h"
#include "verification/record/verdict.h"

#include <Eigen/Cholesky>

#include <limits>

namespace homespun::verification
{
namespace
{
/// Of L^-1 (A − B) L^-T with B = L L^T, ascending.
Eigen::Vector3d relative_eigenvalues(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B)
{
  // Neither a factorization nor an iteration for eigenvalues is sure to hand on what is not a
  // number.
  const Eigen::LLT<Eigen::Matrix3d> factors(B);
  if (!A.allFinite() || !B.allFinite() || factors.info() != Eigen::Success)
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::Matrix3d half = factors.matrixL().solve(A - B);
  const Eigen::Matrix3d both = factors.matrixL().solve(half.transpose());
  return meshes::symmetric_eigen<3>(0.5 * (both + both.transpose())).values;
}
} // namespace

double energy_difference(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B)
{
  const Eigen::Vector3d all = relative_eigenvalues(A, B);
  return larger(std::abs(all(0)), std::abs(all(2)));
}

double order_violation(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B)
{
  return larger(0., relative_eigenvalues(A, B)(2));
}
} // namespace homespun::verification
