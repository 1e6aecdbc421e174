// SPDX-License-Identifier: MIT
#include "shell/membrane/plate_stiffness.h"

namespace homespun::shell
{
PlateStiffness PlateStiffness::isotropic(const double D, const double nu)
{
  return {D, D, nu * D, 0.5 * (1. - nu) * D};
}

Eigen::Matrix3d PlateStiffness::matrix() const
{
  Eigen::Matrix3d D;
  D << D11, D12, 0., D12, D22, 0., 0., 0., D66;
  return D;
}

bool PlateStiffness::is_positive_definite() const
{
  return matrix().allFinite() && D11 > 0. && D22 > 0. && D66 > 0. && D12 * D12 < D11 * D22;
}
} // namespace homespun::shell
