// SPDX-License-Identifier: MIT
#include "shell/membrane/plate_stiffness.h"

#include <Eigen/Cholesky>

namespace homespun::shell
{
PlateStiffness PlateStiffness::isotropic(const double D, const double nu)
{
  return {D, D, nu * D, 0.5 * (1. - nu) * D};
}

PlateStiffness PlateStiffness::from(const Eigen::Matrix3d &D)
{
  return {D(0, 0), D(1, 1), D(0, 1), D(2, 2), D(0, 2), D(1, 2)};
}

Eigen::Matrix3d PlateStiffness::matrix() const
{
  Eigen::Matrix3d D;
  D << D11, D12, D16, D12, D22, D26, D16, D26, D66;
  return D;
}

bool PlateStiffness::is_positive_definite() const
{
  return matrix().allFinite() && D11 > 0. && D22 > 0. && D66 > 0. && D12 * D12 < D11 * D22 &&
         matrix().llt().info() == Eigen::Success;
}
} // namespace homespun::shell
