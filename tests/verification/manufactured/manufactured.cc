// SPDX-License-Identifier: MIT
#include "tests/verification/manufactured/manufactured.h"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace homespun::verification
{
namespace
{
/// ½ e:C:e
template <typename Scalar>
Scalar quadratic(const Eigen::Matrix3d &stiffness, const Scalar (&strain)[3])
{
  Scalar result = 0.;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      result += 0.5 * stiffness(a, b) * strain[a] * strain[b];
  return result;
}

/// The unit vector of the largest Young's modulus, by a search of directions and by halves: without
/// angles, because it is asked for at every point.
Eigen::Vector2d stiffest_direction(const Eigen::Matrix3d &stiffness)
{
  const Eigen::Matrix3d S = stiffness.inverse();
  const auto pull         = [](const Eigen::Vector2d &a)
  { return Eigen::Vector3d(a(0) * a(0), a(1) * a(1), a(0) * a(1)); };
  const auto slope = [&](const Eigen::Vector2d &a)
  {
    const double c = a(0), s = a(1);
    return pull(a).dot(S * Eigen::Vector3d(-2. * c * s, 2. * c * s, c * c - s * s));
  };
  const Eigen::Vector2d steps[] = {{1., 0.}, {2., 1.},  {1., 1.},  {1., 2.},
                                   {0., 1.}, {-1., 2.}, {-1., 1.}, {-2., 1.}};
  int best                      = 0;
  const auto compliance         = [&](const int k)
  {
    const Eigen::Vector3d of = pull(steps[k].normalized());
    return of.dot(S * of);
  };
  for (int k = 1; k < 8; ++k)
    if (compliance(k) < compliance(best))
      best = k;
  Eigen::Vector2d from = best > 0 ? steps[best - 1] : Eigen::Vector2d(2., -1.),
                  to   = best < 7 ? steps[best + 1] : Eigen::Vector2d(-1., 0.);
  from.normalize();
  to.normalize();
  for (int halving = 0; halving < 54; ++halving)
  {
    const Eigen::Vector2d middle     = (from + to).normalized();
    (slope(middle) < 0. ? from : to) = middle;
  }
  return (from + to).normalized();
}

/// The stretches of yarns along a and across it, and sin gamma of their angle.
template <typename Scalar>
Scalar yarn_energy(const Eigen::Matrix3d &stiffness, const Eigen::Vector2d &along,
                   const Scalar (&c)[3])
{
  using std::asin;
  using std::sqrt;
  const double p = along(0), q = along(1);
  const Scalar g11 = p * p * c[0] + q * q * c[1] + 2. * p * q * c[2],
               g22 = q * q * c[0] + p * p * c[1] - 2. * p * q * c[2],
               g12 = p * q * (c[1] - c[0]) + (p * p - q * q) * c[2];
  const Scalar l1 = sqrt(g11), l2 = sqrt(g22);
  // The strain back in the axes of the stiffness: the form e·C·e is the same in all axes.
  const Scalar e[3] = {l1 - 1., l2 - 1., asin(g12 / (l1 * l2))};
  return quadratic<Scalar>(stiffness, {p * p * e[0] + q * q * e[1] - p * q * e[2],
                                       q * q * e[0] + p * p * e[1] + p * q * e[2],
                                       2. * p * q * (e[0] - e[1]) + (p * p - q * q) * e[2]});
}

using Complex = std::complex<double>;

/// The slopes of a function by C11, C22, C12, each by a complex step: no difference is taken, and
/// any small number serves.
template <typename Function>
std::array<double, 3> slopes_of(const Function &function, const double (&c)[3])
{
  constexpr double small = 1e-30;
  std::array<double, 3> slopes;
  for (std::size_t a = 0; a < 3; ++a)
  {
    Complex moved[3] = {c[0], c[1], c[2]};
    moved[a] += Complex(0., small);
    slopes[a] = function(moved).imag() / small;
  }
  return slopes;
}

/// W of a law but linear as a function of C11, C22, C12 of C = F^T F, which may have imaginary
/// parts.
/// @param along direction of the first yarns
template <typename Scalar>
Scalar energy(const Law law, const Eigen::Matrix3d &stiffness, const Eigen::Vector2d &along,
              const Scalar (&c)[3])
{
  using std::sqrt;
  if (law == Law::green)
    return quadratic<Scalar>(stiffness, {0.5 * (c[0] - 1.), 0.5 * (c[1] - 1.), c[2]});
  if (is_of_yarns(law))
    return yarn_energy(stiffness, along, c);
  const Scalar root  = sqrt(c[0] * c[1] - c[2] * c[2]);
  const Scalar trace = sqrt(c[0] + c[1] + 2. * root);
  return quadratic<Scalar>(
    stiffness, {(c[0] + root) / trace - 1., (c[1] + root) / trace - 1., 2. * c[2] / trace});
}

EnergyAndStress linear_law(const Eigen::Matrix3d &stiffness, const Eigen::Matrix<double, 3, 2> &F)
{
  const Eigen::Vector3d strain(F(0, 0) - 1., F(1, 1) - 1., F(0, 1) + F(1, 0));
  const Eigen::Vector3d stress = stiffness * strain;
  EnergyAndStress result;
  result.energy = 0.5 * strain.dot(stress);
  result.stress << stress(0), stress(2), stress(2), stress(1), 0., 0.;
  return result;
}
/// The direction of the first yarns of a law that knows of some.
Eigen::Vector2d first_yarns(const Law law, const Eigen::Matrix3d &stiffness)
{
  return is_of_yarns(law) ? stiffest_direction(stiffness) : Eigen::Vector2d::UnitX();
}

EnergyAndStress energy_and_stress(const Law law, const Eigen::Matrix3d &stiffness,
                                  const Eigen::Vector2d &along,
                                  const Eigen::Matrix<double, 3, 2> &F)
{
  if (law == Law::linear)
    return linear_law(stiffness, F);
  const Eigen::Matrix2d C = F.transpose() * F;
  const double c[3]       = {C(0, 0), C(1, 1), C(0, 1)};
  EnergyAndStress result;
  result.energy                     = energy<double>(law, stiffness, along, c);
  const std::array<double, 3> slope = slopes_of(
    [&](const Complex(&moved)[3]) { return energy<Complex>(law, stiffness, along, moved); }, c);
  Eigen::Matrix2d twice; // dW = P : dF, dC = dF^T F + F^T dF
  twice << 2. * slope[0], slope[2], slope[2], 2. * slope[1];
  result.stress = F * twice;
  return result;
}

/// −Div P by central differences of fourth order.
/// @param stress P at a rest point
template <typename Stress>
Eigen::Vector3d minus_divergence(const Stress &stress, const Eigen::RowVector2d &rest_point,
                                 const double step)
{
  constexpr double weights[2] = {8. / 12., -1. / 12.};
  Eigen::Vector3d divergence  = Eigen::Vector3d::Zero();
  for (int j = 0; j < 2; ++j)
    for (int k = 1; k <= 2; ++k)
      for (const int sign : {-1, 1})
      {
        Eigen::RowVector2d at = rest_point;
        at(j) += sign * k * step;
        divergence += sign * weights[k - 1] / step * stress(at).col(j);
      }
  return -divergence;
}
} // namespace

EnergyAndStress energy_and_stress(const Law law, const Eigen::Matrix3d &stiffness,
                                  const Eigen::Matrix<double, 3, 2> &F)
{
  return energy_and_stress(law, stiffness, first_yarns(law, stiffness), F);
}

Eigen::Vector3d equilibrium_force(const Law law, const StiffnessField &stiffness,
                                  const GradientField &gradient,
                                  const Eigen::RowVector2d &rest_point, const double step)
{
  return minus_divergence([&](const Eigen::RowVector2d &at)
                          { return energy_and_stress(law, stiffness(at), gradient(at)).stress; },
                          rest_point, step);
}

Eigen::Vector3d equilibrium_force(const Law law, const Eigen::Matrix3d &stiffness,
                                  const GradientField &gradient,
                                  const Eigen::RowVector2d &rest_point, const double step)
{
  const Eigen::Vector2d along = first_yarns(law, stiffness);
  return minus_divergence([&](const Eigen::RowVector2d &at)
                          { return energy_and_stress(law, stiffness, along, gradient(at)).stress; },
                          rest_point, step);
}
} // namespace homespun::verification
