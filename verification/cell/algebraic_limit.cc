// SPDX-License-Identifier: MIT
#include "verification/cell/algebraic_limit.h"

#include "meshes/plain/epsilon.h"
#include "meshes/plain/symmetric_eigen.h"

#include <algorithm>
#include <limits>

namespace homespun::verification
{
using homogenization::UnitCell;

double contrast_of(const std::vector<Eigen::Matrix3d> &stiffnesses)
{
  double least = std::numeric_limits<double>::infinity(), most = 0.;
  for (const Eigen::Matrix3d &c : stiffnesses)
  {
    const Eigen::Vector3d values = meshes::symmetric_eigen<3>(c).values;
    least                        = std::min(least, values(0));
    most                         = std::max(most, values(2));
  }
  return most / least;
}

double algebraic_limit(const UnitCell &cell, const double rows)
{
  const std::vector<Eigen::Matrix3d> stiffnesses = cell.stiffness_of_phase();
  const double rigid_motion = rows * meshes::epsilon * contrast_of(stiffnesses);
  double anisotropy         = 1.;
  for (const Eigen::Matrix3d &c : stiffnesses)
    anisotropy = std::max(anisotropy, contrast_of({c}));
  return 1e-11 + rigid_motion * rigid_motion + 16. * meshes::epsilon * anisotropy;
}
} // namespace homespun::verification
