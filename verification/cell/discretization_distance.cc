// SPDX-License-Identifier: MIT
#include "verification/cell/discretization_distance.h"

#include "homogenization/cell/corners.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
double DiscretizationDistance::uncertainty(const double order) const
{
  return safety() *
         (std::abs(p1_to_refined) + std::abs(p2_to_refined) / (std::pow(2., order) - 1.));
}

double DiscretizationDistance::safety() const
{
  return std::abs(p2_to_refined) < std::abs(p1_to_p2) ? 1.25 : safety_unconfirmed;
}

double order_of_p2(const homogenization::UnitCell &cell, const double highest)
{
  return order_of_p2(cell, cell.stiffness_of_phase(), highest);
}

double order_of_p2(const homogenization::UnitCell &cell,
                   const std::vector<Eigen::Matrix3d> &stiffness_of_phase, const double highest)
{
  const homogenization::Singularity corners = homogenization::singularity_of(
    homogenization::corners_of(cell.mesh, cell.lattice, stiffness_of_phase));
  return corners.exists ? std::min(2. * corners.strongest, highest) : highest;
}

double factor_of_bars(const double order)
{
  return 1.25 / (1. - std::pow(2., -order));
}

double factor_of_bars(const homogenization::UnitCell &cell)
{
  return factor_of_bars(order_of_p2(cell, 2.));
}
} // namespace homespun::verification
