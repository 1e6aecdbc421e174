// SPDX-License-Identifier: MIT
// Bars of moduli against the moduli themselves at the ends of what they bound.
#include "verification/cell/moduli_bars.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace homespun::verification;
using homespun::homogenization::EngineeringConstants;

namespace
{
Eigen::Matrix3d stiffness()
{
  Eigen::Matrix3d C;
  C << 900., 150., 60., 150., 400., -30., 60., -30., 260.;
  return C;
}

std::array<double, 5> moduli_of(const Eigen::Matrix3d &S)
{
  return {1. / S(0, 0), 1. / S(1, 1), 1. / S(2, 2), -S(0, 1) / S(0, 0), -S(0, 1) / S(1, 1)};
}

std::array<double, 5> entries(const EngineeringConstants &of)
{
  return {of.E1, of.E2, of.G12, of.nu12, of.nu21};
}
} // namespace

TEST(exact_moduli_bars, the_worst_compliance_within_its_bars_is_as_far_as_the_bars_say)
{
  const Eigen::Matrix3d S = stiffness().inverse();
  Eigen::Matrix3d bars;
  bars << 0.05, 0.01, 0.01, 0.01, 0.1, 0.01, 0.01, 0.01, 0.2;
  bars                             = bars.cwiseProduct(S.cwiseAbs()).eval();
  const std::array<double, 5> said = entries(bars_of_moduli(S, bars)), middle = moduli_of(S);
  std::array<double, 5> farthest{};
  for (int corner = 0; corner < 64; ++corner)
  {
    Eigen::Matrix3d there = S;
    int bit               = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
      {
        const double step = ((corner >> bit++) & 1) != 0 ? bars(i, j) : -bars(i, j);
        there(i, j) += step;
        there(j, i) = there(i, j);
      }
    const std::array<double, 5> moduli = moduli_of(there);
    for (std::size_t k = 0; k < 5; ++k)
      farthest[k] = std::max(farthest[k], std::abs(moduli[k] - middle[k]));
  }
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(said[k], farthest[k], 1e-12 * std::abs(middle[k])) << k;
}

TEST(bound_moduli_bars, every_stiffness_between_two_sides_has_its_moduli_within_the_bars)
{
  Eigen::Matrix3d width;
  width << 30., 5., -4., 5., 20., 6., -4., 6., 15.; // positive definite
  const Eigen::Matrix3d lower = stiffness(), upper = lower + width;
  const Eigen::Matrix3d of = lower + 0.5 * width, S = of.inverse();
  const std::array<double, 5> said   = entries(bars_of_moduli(S, compliance_bars(lower, upper))),
                              middle = moduli_of(S);
  const Verdict check                = check_of_moduli("C^H", of, lower, upper);
  EXPECT_NEAR(check.value, 1., 1e-9);
  EXPECT_EQ(check.outcome, Outcome::pass);
  const Eigen::Matrix3d half = width.llt().matrixL();
  int n                      = 0;
  for (double a = 0.; a <= 1.; a += 0.25)
    for (double b = 0.; b <= 1.; b += 0.25)
      for (double c = 0.; c <= 1.; c += 0.25, ++n)
      {
        const Eigen::Matrix3d C =
          lower + half * Eigen::Vector3d(a, b, c).asDiagonal() * half.transpose();
        const std::array<double, 5> moduli = moduli_of(C.inverse());
        for (std::size_t k = 0; k < 5; ++k)
          EXPECT_LE(std::abs(moduli[k] - middle[k]), said[k]) << k;
      }
  EXPECT_EQ(n, 125);
}
