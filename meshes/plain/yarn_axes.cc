// SPDX-License-Identifier: MIT
#include "meshes/plain/yarn_axes.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homespun::meshes
{
namespace
{
/// S11 of a compliance along the direction at an angle, and its first two derivatives by it.
struct Compliance
{
  double value, slope, curvature;
};

/// 1/E = c0 + c1 cos 2a + s1 sin 2a + c2 cos 4a + s2 sin 4a.
struct ComplianceOfDirection
{
  double c0, c1, s1, c2, s2;

  explicit ComplianceOfDirection(const Eigen::Matrix3d &S)
      : c0((3. * (S(0, 0) + S(1, 1)) + 2. * S(0, 1) + S(2, 2)) / 8.)
      , c1(0.5 * (S(0, 0) - S(1, 1)))
      , s1(0.5 * (S(0, 2) + S(1, 2)))
      , c2((S(0, 0) + S(1, 1) - 2. * S(0, 1) - S(2, 2)) / 8.)
      , s2(0.25 * (S(0, 2) - S(1, 2)))
  {
  }

  Compliance at(const double angle) const
  {
    const double c = std::cos(2. * angle), s = std::sin(2. * angle);
    const double cc = c * c - s * s, ss = 2. * s * c;
    return {c0 + c1 * c + s1 * s + c2 * cc + s2 * ss,
            2. * (s1 * c - c1 * s) + 4. * (s2 * cc - c2 * ss),
            -4. * (c1 * c + s1 * s) - 16. * (c2 * cc + s2 * ss)};
  }

  double variation() const
  {
    return std::abs(c1) + std::abs(s1) + std::abs(c2) + std::abs(s2);
  }
};

/// The angle of the least compliance, in (−pi/2, pi/2].
double stiffest_angle(const ComplianceOfDirection &compliance)
{
  constexpr int n = 16; // directions of half a turn
  double best = 0., value = compliance.at(0.).value;
  // A later direction has to be better by more than round-off, so that of equals the first counts.
  for (int k = 1; k < n; ++k)
  {
    const double angle = (k % 2 == 1 ? 1. : -1.) * ((k + 1) / 2) * M_PI / n;
    if (const double here = compliance.at(angle).value; here < value - 1e-12 * compliance.c0)
    {
      best  = angle;
      value = here;
    }
  }
  for (int step = 0; step < 20; ++step)
  {
    const Compliance here = compliance.at(best);
    if (!(here.curvature > 0.))
      break;
    const double change = std::clamp(-here.slope / here.curvature, -0.1, 0.1);
    best += change;
    if (std::abs(change) < 1e-15)
      break;
  }
  return std::abs(best) < 1e-12 ? 0. : best;
}
} // namespace

YarnAxes yarn_axes(const Eigen::Matrix3d &C)
{
  const ComplianceOfDirection compliance(C.inverse());
  YarnAxes yarns;
  yarns.C = C;
  if (!(compliance.variation() > 1e-6 * compliance.c0))
    return yarns;
  yarns.are_there    = true;
  const double angle = stiffest_angle(compliance), c = std::cos(angle), s = std::sin(angle);
  yarns.axes << c, -s, s, c;
  yarns.turns << c * c, s * s, c * s, //
    s * s, c * c, -c * s,             //
    -2. * c * s, 2. * c * s, c * c - s * s;
  const Eigen::Matrix3d back = yarns.turns.inverse();
  yarns.C                    = back.transpose() * C * back;
  return yarns;
}
} // namespace homespun::meshes
