// SPDX-License-Identifier: MIT
#include "meshes/plain/gauss_rule.h"

#include <cmath>
#include <utility>

namespace homespun::meshes
{
namespace
{
/// P_n and its slope, by the recurrence of three terms.
std::pair<double, double> legendre(const int n, const double x)
{
  double value = 1., before = 0.; // P_0, and none before it
  for (int k = 1; k <= n; ++k)
  {
    const double next = ((2. * k - 1.) * x * value - (k - 1.) * before) / k;
    before            = value;
    value             = next;
  }
  return {value, n * (x * value - before) / (x * x - 1.)};
}
} // namespace

GaussRule gauss_rule(const int n)
{
  constexpr int steps = 8; // each doubles the digits, of which the first guess has some three
  GaussRule rule      = {Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i)
  {
    double x = -std::cos(M_PI * (i + 0.75) / (n + 0.5));
    for (int newton = 0; newton < steps; ++newton)
    {
      const auto [value, slope] = legendre(n, x);
      x -= value / slope;
    }
    const double slope = legendre(n, x).second;
    rule.points(i)     = x;
    rule.weights(i)    = 2. / ((1. - x * x) * slope * slope);
  }
  return rule;
}
} // namespace homespun::meshes
