// SPDX-License-Identifier: MIT
#include "verification/laws/first_loss.h"

#include "meshes/plain/errors.h"
#include "verification/laws/ellipticity.h"
#include "verification/reference/free_sides.h"

#include <algorithm>

namespace homespun::verification
{
double first_loss(const Law law, const Eigen::Matrix3d &C,
                  const std::function<Eigen::Matrix2d(double strain)> &gradient,
                  const double largest)
{
  const EllipticityOfLaw ellipticity(law, C);
  const auto is_kept = [&](const double strain) { return ellipticity.at(gradient(strain)) > 0.; };
  try
  {
    double kept = 0.;
    for (double strain = std::min(1e-5, largest);; strain = std::min(1.1 * strain, largest))
    {
      if (!is_kept(strain))
      {
        double lost = strain;
        while (lost - kept > 4. * std::numeric_limits<double>::epsilon() * lost)
        {
          const double middle             = 0.5 * (kept + lost);
          (is_kept(middle) ? kept : lost) = middle;
        }
        return lost;
      }
      if (strain >= largest)
        return never;
      kept = strain;
    }
  }
  catch (const meshes::NotConverged &)
  {
    return never;
  }
}

Eigen::Matrix2d uniaxial_gradient(const Law law, const Eigen::Matrix3d &C, const int axis,
                                  const Direction direction, const double strain)
{
  const Load load(axis == 1 ? "uniaxial-1" : "uniaxial-2");
  const double along = direction == Direction::tension ? strain : -strain;
  return load.gradient(along, free_strains_of(load, law, C, along));
}

double uniaxial_loss(const Law law, const Eigen::Matrix3d &C, const int axis,
                     const Direction direction)
{
  return first_loss(
    law, C, [&](const double strain) { return uniaxial_gradient(law, C, axis, direction, strain); },
    direction == Direction::tension ? 1. : 0.5);
}
} // namespace homespun::verification
