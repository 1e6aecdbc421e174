// SPDX-License-Identifier: MIT
// The second order of the laws against the strains themselves, by the order of what is left.
#include "homogenization/cell/quadratic_strain.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
const auto both_laws = {Law::biot, Law::green};

Eigen::Matrix2d matrix_of(const GradientEntries &H)
{
  Eigen::Matrix2d matrix;
  matrix << H(0), H(1), H(2), H(3);
  return matrix;
}

/// The whole strain, by the square root of its eigenvalues: written apart from the product.
Eigen::Vector3d strain_of(const Law law, const GradientEntries &H)
{
  const Eigen::Matrix2d F = Eigen::Matrix2d::Identity() + matrix_of(H);
  const Eigen::Matrix2d E =
    law == Law::green
      ? Eigen::Matrix2d(0.5 * (F.transpose() * F - Eigen::Matrix2d::Identity()))
      : Eigen::Matrix2d(
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(F.transpose() * F).operatorSqrt() -
          Eigen::Matrix2d::Identity());
  return {E(0, 0), E(1, 1), 2. * E(0, 1)};
}

Eigen::Vector3d value_of(const QuadraticStrain &q, const GradientEntries &H)
{
  return {H.dot(q[0] * H), H.dot(q[1] * H), H.dot(q[2] * H)};
}
} // namespace

TEST(derivative_quadratic_strain, strains_agree_with_their_second_order_up_to_the_third)
{
  for (const Law law : both_laws)
    for (const GradientEntries &H :
         {GradientEntries(0.3, -0.8, 0.5, 0.7), GradientEntries(-0.2, 0.9, 0.4, 0.1)})
    {
      const auto left = [&](const double s)
      {
        return (strain_of(law, s * H) - s * (linear_strain() * H) -
                s * s * value_of(quadratic_strain(law), H))
          .norm();
      };
      const double order = std::log2(left(0.02) / left(0.01));
      if (law == Law::green)
        EXPECT_LT(left(0.02), 1e-16) << "its second order is all there is";
      else
        EXPECT_NEAR(order, 3., 0.1);
    }
}

TEST(exact_quadratic_strain, a_symmetric_gradient_has_no_second_order_under_biot)
{
  const QuadraticStrain q = quadratic_strain(Law::biot);
  EXPECT_LT(value_of(q, {0.4, 0.3, 0.3, -0.2}).norm(), 1e-16);
}

TEST(derivative_quadratic_strain, the_stress_of_second_order_is_the_third_derivative_of_the_energy)
{
  Eigen::Matrix3d c;
  c << 5., 1.2, 0.3, 1.2, 4., -0.4, 0.3, -0.4, 1.5;
  for (const Law law : both_laws)
  {
    const QuadraticStrain q = quadratic_strain(law);
    const auto W3           = [&](const GradientEntries &H)
    { return (c * linear_strain() * H).dot(value_of(q, H)); };
    const GradientEntries F(0.3, -0.8, 0.5, 0.7), G(-0.2, 0.9, 0.4, 0.1), H(0.6, 0.2, -0.5, 0.8);
    // The polarisation of a cubic form is exact.
    const double third = W3(F + G + H) - W3(F + G) - W3(F + H) - W3(G + H) + W3(F) + W3(G) + W3(H);
    EXPECT_NEAR(second_order_stress(c, q, F, G).dot(H), third, 1e-13 * c.norm());
    EXPECT_NEAR(second_order_stress(c, q, F, F).dot(F), 6. * W3(F), 1e-13 * c.norm());
  }
}
