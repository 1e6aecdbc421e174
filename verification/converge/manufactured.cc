// SPDX-License-Identifier: MIT
#include "verification/converge/manufactured.h"

#include <cmath>
#include <complex>

namespace homespun::verification
{
namespace
{
/// W of a law; products are transposed, never conjugated, so that F may have an imaginary part.
template <typename Scalar>
Scalar energy(const Law law, const Eigen::Matrix3d &stiffness, const Eigen::Matrix<Scalar, 3, 2> &F)
{
  using std::sqrt;
  Scalar strain[3];
  if (law == Law::linear)
  {
    strain[0] = F(0, 0) - 1.;
    strain[1] = F(1, 1) - 1.;
    strain[2] = F(0, 1) + F(1, 0);
  }
  else
  {
    Scalar c11 = 0., c22 = 0., c12 = 0.;
    for (int i = 0; i < 3; ++i)
    {
      c11 += F(i, 0) * F(i, 0);
      c22 += F(i, 1) * F(i, 1);
      c12 += F(i, 0) * F(i, 1);
    }
    if (law == Law::green)
    {
      strain[0] = 0.5 * (c11 - 1.);
      strain[1] = 0.5 * (c22 - 1.);
      strain[2] = c12;
    }
    else
    {
      const Scalar root  = sqrt(c11 * c22 - c12 * c12);
      const Scalar trace = sqrt(c11 + c22 + 2. * root);
      strain[0]          = (c11 + root) / trace - 1.;
      strain[1]          = (c22 + root) / trace - 1.;
      strain[2]          = 2. * c12 / trace;
    }
  }
  Scalar result = 0.;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      result += 0.5 * stiffness(a, b) * strain[a] * strain[b];
  return result;
}
} // namespace

EnergyAndStress energy_and_stress(const Law law, const Eigen::Matrix3d &stiffness,
                                  const Eigen::Matrix<double, 3, 2> &F)
{
  EnergyAndStress result;
  result.energy                      = energy<double>(law, stiffness, F);
  constexpr double small             = 1e-30; // no difference is taken: any small number serves
  using Complex                      = std::complex<double>;
  Eigen::Matrix<Complex, 3, 2> moved = F.cast<Complex>();
  result.stress.setZero();
  const int n_rows = F.row(2).isZero(0.) ? 2 : 3; // in the plane there is no force along the normal
  for (int i = 0; i < n_rows; ++i)
    for (int j = 0; j < 2; ++j)
    {
      moved(i, j)         = Complex(F(i, j), small);
      result.stress(i, j) = energy<Complex>(law, stiffness, moved).imag() / small;
      moved(i, j)         = F(i, j);
    }
  return result;
}

Eigen::Vector3d equilibrium_force(const Law law, const Eigen::Matrix3d &stiffness,
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
                      energy_and_stress(law, stiffness, gradient(at)).stress.col(j);
      }
  return -divergence;
}
} // namespace homespun::verification
