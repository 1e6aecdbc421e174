// SPDX-License-Identifier: MIT
#include "shell/membrane/guarded_cubic.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::shell
{
namespace
{
/// An upper bound on |T(u,u,u)| over u.C u = 1, from a net on half of the sphere. On the great
/// circle from the maximum to the nearest point of the net T is a trigonometric polynomial of
/// degree three, which stays above its maximum times cos(3 angle) (M. Riesz).
double largest_value(const meshes::CubicForm &energy, const Eigen::Matrix3d &C)
{
  constexpr int n_rings = 40; // of a half circle
  constexpr double ring = M_PI / n_rings;
  const double covered  = ring / std::sqrt(2.); // angle from anywhere to the net, at most
  const Eigen::LLT<Eigen::Matrix3d> cholesky(C);
  double largest = 0.;
  for (int i = 0; i <= n_rings; ++i)
    for (int j = 0; j < n_rings; ++j)
    {
      const double polar = i * ring, azimuth = j * ring;
      const Eigen::Vector3d unit(std::sin(polar) * std::cos(azimuth),
                                 std::sin(polar) * std::sin(azimuth), std::cos(polar));
      largest = std::max(largest, std::abs(6. * energy.value(cholesky.matrixU().solve(unit))));
    }
  return largest / std::cos(3. * covered);
}
} // namespace

/// phi = P(x)/x³, and phi'(x), phi''(x), beyond the reach.
struct GuardedCubic::Damping
{
  double phi, first, second;
};

GuardedCubic::GuardedCubic(const meshes::CubicForm &energy, const Eigen::Matrix3d &stiffness)
    : energy(energy)
    , C(stiffness)
{
  const double tau = largest_value(energy, C);
  r0               = tau > 0. ? 1. / (3. * tau) : std::numeric_limits<double>::infinity();
}

GuardedCubic::Damping GuardedCubic::damping(const double size) const
{
  const double x  = size / r0;
  const double x2 = x * x, x3 = x2 * x, x4 = x3 * x, x5 = x4 * x;
  if (x < 1.5)
    return {-2. + 9. / x - 9. / x2 + 3. / x3, -9. / x2 + 18. / x3 - 9. / x4,
            18. / x3 - 54. / x4 + 36. / x5};
  return {4.5 / x2 - 3.75 / x3, -9. / x3 + 11.25 / x4, 27. / x4 - 45. / x5};
}

bool GuardedCubic::is_trusted(const Eigen::Vector3d &strain) const
{
  return !(strain.dot(C * strain) > r0 * r0);
}

double GuardedCubic::value(const Eigen::Vector3d &strain) const
{
  if (is_trusted(strain))
    return energy.value(strain);
  return damping(std::sqrt(strain.dot(C * strain))).phi * energy.value(strain);
}

Eigen::Vector3d GuardedCubic::gradient(const Eigen::Vector3d &strain) const
{
  if (is_trusted(strain))
    return energy.gradient(strain);
  return derivatives(strain).gradient;
}

Eigen::Matrix3d GuardedCubic::hessian(const Eigen::Vector3d &strain) const
{
  return derivatives(strain).hessian;
}

GuardedCubic::Derivatives GuardedCubic::derivatives(const Eigen::Vector3d &strain) const
{
  const Eigen::Matrix3d own   = energy.hessian(strain);
  const Eigen::Vector3d force = 0.5 * (own * strain);
  if (is_trusted(strain))
    return {force, own};
  const Eigen::Vector3d stress = C * strain; // |e| times the gradient of |e|
  const double size            = std::sqrt(strain.dot(stress));
  const Damping damped         = damping(size);
  const double value = force.dot(strain) / 3., first = damped.first / (size * r0);
  const Eigen::Matrix3d coupled = stress * force.transpose();
  return {damped.phi * force + (value * first) * stress,
          damped.phi * own + first * (coupled + coupled.transpose()) +
            value *
              ((damped.second / (r0 * r0) - first) / (size * size) * stress * stress.transpose() +
               first * C)};
}

TangentLaw tangent_law(const Eigen::Matrix3d &D, const GuardedCubic &cubic,
                       const Eigen::Vector3d &strain, const Eigen::Vector3d &initial_stress)
{
  const GuardedCubic::Derivatives of = cubic.derivatives(strain);
  return {Eigen::Matrix3d(D + of.hessian), initial_stress + of.gradient - of.hessian * strain};
}
} // namespace homespun::shell
