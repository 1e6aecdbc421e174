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

const Phase phase   = {"any", 10., 3., 0.3, 0.4, 25., 1., 1.};
const auto all_laws = {Law::biot, Law::green, Law::yarn};

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
  if (law == Law::yarn)
  {
    const double angle = M_PI / 180. * phase.angle, c = std::cos(angle), s = std::sin(angle);
    const Eigen::Vector2d f1 = F * Eigen::Vector2d(c, s), f2 = F * Eigen::Vector2d(-s, c);
    const Eigen::Vector3d e(f1.norm() - 1., f2.norm() - 1.,
                            std::asin(f1.dot(f2) / (f1.norm() * f2.norm())));
    return {c * c * e(0) + s * s * e(1) - c * s * e(2), s * s * e(0) + c * c * e(1) + c * s * e(2),
            2. * c * s * (e(0) - e(1)) + (c * c - s * s) * e(2)};
  }
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
  for (const Law law : all_laws)
    for (const GradientEntries &H :
         {GradientEntries(0.3, -0.8, 0.5, 0.7), GradientEntries(-0.2, 0.9, 0.4, 0.1)})
    {
      const auto left = [&](const double s)
      {
        return (strain_of(law, s * H) - s * (linear_strain() * H) -
                s * s * value_of(quadratic_strain(law, phase), H))
          .norm();
      };
      const double order = std::log2(left(0.02) / left(0.01));
      if (law == Law::green)
        EXPECT_LT(left(0.02), 1e-16) << "its second order is all there is";
      else
        EXPECT_NEAR(order, 3., 0.1);
    }
}

TEST(exact_quadratic_strain, a_phase_without_axes_has_no_yarns_and_keeps_biot)
{
  const Phase isotropic_phase   = isotropic("plain", 3., 0.2, 1., 1.);
  const QuadraticStrain of_yarn = quadratic_strain(Law::yarn, isotropic_phase),
                        of_biot = quadratic_strain(Law::biot, isotropic_phase);
  for (std::size_t k = 0; k < of_yarn.size(); ++k)
    EXPECT_EQ(of_yarn[k], of_biot[k]);
  EXPECT_EQ(laws_of_second_order({isotropic_phase}).size(), 2u);
  EXPECT_EQ(laws_of_second_order({isotropic_phase, phase}).back(), Law::yarn);
}

TEST(exact_quadratic_strain, a_symmetric_gradient_has_no_second_order_under_biot)
{
  const QuadraticStrain q = quadratic_strain(Law::biot, phase);
  EXPECT_LT(value_of(q, {0.4, 0.3, 0.3, -0.2}).norm(), 1e-16);
}

TEST(derivative_quadratic_strain, the_stress_of_second_order_is_the_third_derivative_of_the_energy)
{
  Eigen::Matrix3d c;
  c << 5., 1.2, 0.3, 1.2, 4., -0.4, 0.3, -0.4, 1.5;
  for (const Law law : all_laws)
  {
    const QuadraticStrain q = quadratic_strain(law, phase);
    const auto W3           = [&](const GradientEntries &H)
    { return (c * linear_strain() * H).dot(value_of(q, H)); };
    const GradientEntries F(0.3, -0.8, 0.5, 0.7), G(-0.2, 0.9, 0.4, 0.1), H(0.6, 0.2, -0.5, 0.8);
    // The polarisation of a cubic form is exact.
    const double third = W3(F + G + H) - W3(F + G) - W3(F + H) - W3(G + H) + W3(F) + W3(G) + W3(H);
    EXPECT_NEAR(second_order_stress(c, q, F, G).dot(H), third, 1e-13 * c.norm());
    EXPECT_NEAR(second_order_stress(c, q, F, F).dot(F), 6. * W3(F), 1e-13 * c.norm());
  }
}
