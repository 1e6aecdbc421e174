// SPDX-License-Identifier: MIT
#include "verification/ellipticity/first_loss.h"

#include "meshes/plain/errors.h"
#include "verification/ellipticity/ellipticity.h"
#include "verification/reference/loads.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace homespun::verification
{
double first_loss(const Law law, const Eigen::Matrix3d &C,
                  const std::function<Eigen::Matrix2d(double strain)> &gradient,
                  const double largest)
{
  const EllipticityOfLaw ellipticity(law, C);
  const auto is_kept = [&](const double strain) { return ellipticity.at(gradient(strain)) > 0.; };
  double kept        = 0.;
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

Eigen::Matrix2d uniaxial_gradient(const Law law, const Eigen::Matrix3d &C, const int axis,
                                  const Direction direction, const double strain)
{
  const Load load(axis == 1 ? "uniaxial-1" : "uniaxial-2");
  const double along = direction == Direction::tension ? strain : -strain;
  // Place of the free strain e among F11, F12, F21, F22.
  const int side = axis == 1 ? 3 : 0;
  double free    = 0.;
  std::vector<double> history;
  for (int newton = 0; newton < 50; ++newton)
  {
    const Eigen::Matrix2d F = load.gradient(along, Eigen::Vector2d(free, 0.));
    const Response here     = response(newton == 0 ? Law::linear : law, C, F);
    const double stress     = here.stress(side);
    // A sum of some ten terms as large as C, with F rounded to a rounding of 1.
    const double round_off = 64. * std::numeric_limits<double>::epsilon() * C.norm();
    history.push_back(std::abs(stress) / here.stress.norm());
    if (newton > 0 && std::abs(stress) <= round_off + 1e-12 * here.stress.norm())
      return F;
    free -= stress / here.tangent(side, side);
  }
  throw meshes::NotConverged("the sides of a pulled cloth do not become free of stress", history);
}

double uniaxial_loss(const Law law, const Eigen::Matrix3d &C, const int axis,
                     const Direction direction)
{
  return first_loss(
    law, C, [&](const double strain) { return uniaxial_gradient(law, C, axis, direction, strain); },
    direction == Direction::tension ? 1. : 0.5);
}
} // namespace homespun::verification
