// SPDX-License-Identifier: MIT
#include "verification/algebraic_limit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

namespace homespun::verification
{
using homogenization::UnitCell;

double contrast_of(const UnitCell &cell)
{
  double least = std::numeric_limits<double>::infinity(), most = 0.;
  for (const Eigen::Matrix3d &c : cell.stiffness_of_phase())
  {
    const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(c).eigenvalues();
    least                        = std::min(least, values(0));
    most                         = std::max(most, values(2));
  }
  return most / least;
}

double algebraic_limit(const UnitCell &cell, const double rows)
{
  constexpr double epsilon  = std::numeric_limits<double>::epsilon();
  const double rigid_motion = rows * epsilon * contrast_of(cell);
  double anisotropy         = 1.;
  for (const homogenization::Phase &phase : cell.phases)
  {
    UnitCell alone = cell;
    alone.phases   = {phase};
    anisotropy     = std::max(anisotropy, contrast_of(alone));
  }
  return 1e-11 + rigid_motion * rigid_motion + 16. * epsilon * anisotropy;
}
} // namespace homespun::verification
