// SPDX-License-Identifier: MIT
#include "meshes/plain/symmetric_eigen.h"
#include "shell/membrane/corotational_energy.h"
#include "tests/verification/law/law_cases.h"
#include "verification/law/space_laws.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using homespun::tests::order_over_six_halvings;
using homespun::tests::some_stiffness;

namespace
{
SpaceGradient gradient_in_space()
{
  SpaceGradient F;
  F << 1.12, 0.31, -0.18, 0.93, 0.4, -0.2;
  return F;
}

/// Shortened along a slanted direction, so that the stress has both signs.
SpaceGradient squeezed()
{
  Eigen::Matrix2d U;
  U << 0.7, 0.1, 0.1, 1.05;
  return Eigen::AngleAxisd(0.8, Eigen::Vector3d(1., 2., -1.).normalized())
           .toRotationMatrix()
           .leftCols<2>() *
         U;
}

Eigen::Matrix3d some_rotation(const double angle)
{
  return Eigen::AngleAxisd(angle, Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
}

SpaceGradient gradient_of(const Eigen::Matrix<double, 6, 1> &entries)
{
  SpaceGradient F;
  for (int a = 0; a < 3; ++a)
    F.row(a) << entries(2 * a), entries(2 * a + 1);
  return F;
}

double smallest_eigenvalue(const SpaceTangent &A)
{
  return meshes::symmetric_eigen<Eigen::Dynamic>(A).values(0);
}
} // namespace

TEST(derivative_space_laws, stress_and_tangent_leave_remainders_of_order_two_and_three)
{
  const Eigen::Matrix3d C = some_stiffness();
  Eigen::Matrix<double, 6, 1> direction;
  direction << 0.7, -0.5, 0.9, 0.4, -0.3, 0.8;
  for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_space))
    for (const SpaceGradient &F : {gradient_in_space(), squeezed()})
    {
      const SpaceResponse at = space_response(law, C, F, Tangent::exact);
      const auto energy      = [&](const double step)
      {
        return space_response(law, C, F + gradient_of(step * direction), Tangent::none).energy -
               at.energy;
      };
      const double slope = (at.stress.array() * gradient_of(direction).array()).sum();
      const double curve = direction.dot(at.tangent * direction);
      const auto first   = [&](const double s) { return std::abs(energy(s) - s * slope); };
      const auto second  = [&](const double s)
      { return std::abs(energy(s) - s * slope - 0.5 * s * s * curve); };
      EXPECT_NEAR(order_over_six_halvings(0.004, first), 2., 0.1) << name_of(law);
      EXPECT_NEAR(order_over_six_halvings(0.004, second), 3., 0.1) << name_of(law);
      EXPECT_LT((at.tangent - at.tangent.transpose()).cwiseAbs().maxCoeff(), 1e-13);
    }
}

TEST(exact_space_laws, a_sheet_in_the_plane_responds_as_the_laws_in_the_plane)
{
  // Two derivations: there by the angle of the rotation, here by the square root of the metric.
  for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_space))
  {
    SpaceGradient F     = gradient_in_space();
    F.row(2)            = Eigen::RowVector2d::Zero();
    const auto in_space = space_response(law, some_stiffness(), F, Tangent::exact);
    const auto in_plane = response(law, some_stiffness(), F.topRows<2>());
    EXPECT_NEAR(in_space.energy, in_plane.energy, 1e-15);
    for (int a = 0; a < 2; ++a)
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(in_space.stress(a, i), in_plane.stress(2 * a + i), 1e-14);
    const Eigen::Matrix4d difference = in_space.tangent.topLeftCorner<4, 4>() - in_plane.tangent;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-13) << name_of(law);
    // Along the normal only the stress resists, and nothing couples with the plane.
    Eigen::Matrix2d second_piola = F.topRows<2>().inverse() * in_space.stress.topRows<2>();
    EXPECT_LT((in_space.tangent.bottomRightCorner<2, 2>() - second_piola).cwiseAbs().maxCoeff(),
              1e-14);
    EXPECT_EQ((in_space.tangent.topRightCorner<4, 2>()).cwiseAbs().maxCoeff(), 0.);
  }
}

TEST(exact_space_laws, biot_in_space_equals_the_element_of_the_coarse_cloth_which_is_written_apart)
{
  for (const SpaceGradient &F : {gradient_in_space(), squeezed()})
  {
    const auto here = space_response(Law::biot, some_stiffness(), F, Tangent::exact);
    EXPECT_NEAR(shell::energy_density<3>(F, some_stiffness()), here.energy, 1e-14);
    EXPECT_LT((shell::energy_gradient<3>(F, some_stiffness()) - here.stress).cwiseAbs().maxCoeff(),
              1e-13);
    const shell::GradientHessian<3> there = shell::energy_hessian<3>(F, some_stiffness());
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) // there the entries of F stand column by column
        EXPECT_NEAR(there(3 * (a % 2) + a / 2, 3 * (b % 2) + b / 2), here.tangent(a, b), 1e-12);
  }
}

TEST(invariant_space_laws, rotations_in_space_change_no_energy_and_rigid_motion_has_no_stress)
{
  for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_space))
  {
    const auto at = space_response(law, some_stiffness(), gradient_in_space(), Tangent::exact);
    for (const double angle : {0.3, 1.7, 3.1})
    {
      const Eigen::Matrix3d R = some_rotation(angle);
      const auto turned =
        space_response(law, some_stiffness(), R * gradient_in_space(), Tangent::exact);
      EXPECT_NEAR(turned.energy, at.energy, 1e-14);
      EXPECT_LT((turned.stress - R * at.stress).cwiseAbs().maxCoeff(), 1e-14);
      const auto at_rest = space_response(law, some_stiffness(), R.leftCols<2>(), Tangent::none);
      EXPECT_LT(at_rest.stress.cwiseAbs().maxCoeff(), 2e-15) << name_of(law);
    }
  }
}

TEST(bound_space_laws, the_positive_tangent_is_positive_and_is_the_exact_one_where_that_is_positive)
{
  for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_space))
  {
    const auto exact    = space_response(law, some_stiffness(), squeezed(), Tangent::exact);
    const auto positive = space_response(law, some_stiffness(), squeezed(), Tangent::projected);
    EXPECT_LT(smallest_eigenvalue(exact.tangent), -0.1) << name_of(law);
    EXPECT_GT(smallest_eigenvalue(positive.tangent), -1e-14) << name_of(law);
    // It is the positive part in the sense of eigenvalues.
    const auto eigen = meshes::symmetric_eigen<Eigen::Dynamic>(exact.tangent);
    const SpaceTangent clamped =
      eigen.vectors * eigen.values.cwiseMax(0.).asDiagonal() * eigen.vectors.transpose();
    EXPECT_LT((positive.tangent - clamped).cwiseAbs().maxCoeff(), 1e-13) << name_of(law);

    const SpaceGradient pulled = 1.2 * some_rotation(0.5).leftCols<2>();
    const auto stable          = space_response(law, some_stiffness(), pulled, Tangent::exact);
    EXPECT_GT(smallest_eigenvalue(stable.tangent), 0.);
    EXPECT_LT(
      (space_response(law, some_stiffness(), pulled, Tangent::projected).tangent - stable.tangent)
        .cwiseAbs()
        .maxCoeff(),
      1e-13);
  }
}

TEST(bound_space_laws, collapsed_triangles_give_finite_answers)
{
  for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_space))
    for (const double across : {0., 1e-300, 1e-12})
      for (const double along : {0., 1.})
      {
        SpaceGradient F = SpaceGradient::Zero();
        F(2, 0)         = along;
        F(1, 1)         = across;
        for (const Tangent tangent : {Tangent::exact, Tangent::projected})
        {
          const auto at = space_response(law, some_stiffness(), F, tangent);
          EXPECT_TRUE(std::isfinite(at.energy));
          EXPECT_TRUE(at.stress.allFinite());
          EXPECT_TRUE(at.tangent.allFinite());
        }
      }
}
