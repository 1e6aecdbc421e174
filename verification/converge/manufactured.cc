// SPDX-License-Identifier: MIT
#include "verification/converge/manufactured.h"

#include <cmath>
#include <complex>

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

/// W of biot or green as a function of C11, C22, C12 of C = F^T F, which may have imaginary parts.
template <typename Scalar>
Scalar energy(const Law law, const Eigen::Matrix3d &stiffness, const Scalar (&c)[3])
{
  using std::sqrt;
  if (law == Law::green)
    return quadratic<Scalar>(stiffness, {0.5 * (c[0] - 1.), 0.5 * (c[1] - 1.), c[2]});
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
} // namespace

EnergyAndStress energy_and_stress(const Law law, const Eigen::Matrix3d &stiffness,
                                  const Eigen::Matrix<double, 3, 2> &F)
{
  if (law == Law::linear)
    return linear_law(stiffness, F);
  const Eigen::Matrix2d C = F.transpose() * F;
  EnergyAndStress result;
  result.energy          = energy<double>(law, stiffness, {C(0, 0), C(1, 1), C(0, 1)});
  constexpr double small = 1e-30; // no difference is taken: any small number serves
  using Complex          = std::complex<double>;
  double slope[3]; // of W by C11, C22, C12
  for (int a = 0; a < 3; ++a)
  {
    Complex moved[3] = {C(0, 0), C(1, 1), C(0, 1)};
    moved[a] += Complex(0., small);
    slope[a] = energy<Complex>(law, stiffness, moved).imag() / small;
  }
  Eigen::Matrix2d twice; // dW = P : dF, dC = dF^T F + F^T dF
  twice << 2. * slope[0], slope[2], slope[2], 2. * slope[1];
  result.stress = F * twice;
  return result;
}

Eigen::Vector3d equilibrium_force(const Law law, const StiffnessField &stiffness,
                                  const GradientField &gradient,
                                  const Eigen::RowVector2d &rest_point, const double step)
{
  constexpr double weights[2] = {8. / 12., -1. / 12.};
  Eigen::Vector3d divergence  = Eigen::Vector3d::Zero();
  for (int j = 0; j < 2; ++j)
    for (int k = 1; k <= 2; ++k)
      for (const int sign : {-1, 1})
      {
        Eigen::RowVector2d at = rest_point;
        at(j) += sign * k * step;
        divergence += sign * weights[k - 1] / step *
                      energy_and_stress(law, stiffness(at), gradient(at)).stress.col(j);
      }
  return -divergence;
}

Eigen::Vector3d equilibrium_force(const Law law, const Eigen::Matrix3d &stiffness,
                                  const GradientField &gradient,
                                  const Eigen::RowVector2d &rest_point, const double step)
{
  return equilibrium_force(
    law, [&](const Eigen::RowVector2d &) { return stiffness; }, gradient, rest_point, step);
}
} // namespace homespun::verification
