// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "meshes/plain/symmetric_eigen.h"
#include "shell/membrane/corotational_energy.h"
#include "tests/verification/law/law_cases.h"
#include "verification/law/laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace homespun;
using namespace homespun::verification;
using homespun::tests::order_over_six_halvings;
using homespun::tests::rotation;
using homespun::tests::some_gradient;
using homespun::tests::some_stiffness;

namespace
{
Eigen::Matrix2d matrix_of(const Eigen::Vector4d &entries)
{
  Eigen::Matrix2d F;
  F << entries(0), entries(1), entries(2), entries(3);
  return F;
}

} // namespace

TEST(derivative_laws, stress_and_tangent_leave_remainders_of_order_two_and_three)
{
  const Eigen::Matrix3d C         = some_stiffness();
  const Eigen::Vector4d direction = Eigen::Vector4d(0.7, -0.5, 0.9, 0.4);
  for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_space))
  {
    const Response at = response(law, C, some_gradient());
    const auto energy = [&](const double step)
    { return response(law, C, some_gradient() + matrix_of(step * direction)).energy - at.energy; };
    const double slope     = at.stress.dot(direction),
                 curvature = direction.dot(at.tangent * direction);
    EXPECT_NEAR(
      order_over_six_halvings(0.02, [&](double s) { return std::abs(energy(s) - s * slope); }), 2.,
      0.1)
      << name_of(law);
    EXPECT_NEAR(
      order_over_six_halvings(
        0.02, [&](double s) { return std::abs(energy(s) - s * slope - 0.5 * s * s * curvature); }),
      3., 0.1)
      << name_of(law);
    EXPECT_LT((at.tangent - at.tangent.transpose()).cwiseAbs().maxCoeff(), 1e-14 * 10.);
  }
}

TEST(exact_laws, biot_is_the_energy_of_the_right_stretch)
{
  const Eigen::Matrix2d F = some_gradient();
  const auto eigen        = meshes::symmetric_eigen<2>(F.transpose() * F);
  const Eigen::Matrix2d U =
    eigen.vectors * eigen.values.cwiseSqrt().asDiagonal() * eigen.vectors.transpose();
  const Eigen::Vector3d strain(U(0, 0) - 1., U(1, 1) - 1., 2. * U(0, 1));
  EXPECT_NEAR(response(Law::biot, some_stiffness(), F).energy,
              0.5 * strain.dot(some_stiffness() * strain), 1e-15);
}

TEST(exact_laws, biot_equals_the_element_of_the_coarse_cloth_which_is_written_apart)
{
  for (const double angle : {0., 0.4, 2.8})
    for (const double stretch : {0.6, 1., 1.4})
    {
      const Eigen::Matrix2d F = rotation(angle) * (stretch * some_gradient());
      const Response here     = response(Law::biot, some_stiffness(), F);
      EXPECT_NEAR(shell::energy_density<2>(F, some_stiffness()), here.energy, 1e-13);
      const Eigen::Matrix2d gradient = shell::energy_gradient<2>(F, some_stiffness());
      EXPECT_LT((gradient - matrix_of(here.stress)).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(invariant_laws, finite_rotations_change_no_energy_but_that_of_linear)
{
  const Eigen::Matrix2d F = some_gradient();
  for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_space))
  {
    const double energy = response(law, some_stiffness(), F).energy;
    for (const double angle : {0.1, 1.5, 3.1})
      EXPECT_NEAR(response(law, some_stiffness(), rotation(angle) * F).energy, energy,
                  1e-13 * energy)
        << name_of(law);
    const Response at_rest = response(law, some_stiffness(), rotation(2.));
    EXPECT_LT(at_rest.stress.cwiseAbs().maxCoeff(), 1e-15) << name_of(law);
  }
  EXPECT_GT(response(Law::linear, some_stiffness(), rotation(0.5)).energy, 0.01);
}

TEST(exact_laws, all_laws_share_the_tangent_at_rest)
{
  const Eigen::Matrix4d linear =
    response(Law::linear, some_stiffness(), Eigen::Matrix2d::Identity()).tangent;
  for (const Law law : all_laws())
    EXPECT_LT((response(law, some_stiffness(), Eigen::Matrix2d::Identity()).tangent - linear)
                .cwiseAbs()
                .maxCoeff(),
              1e-14)
      << name_of(law);
}

TEST(bound_laws, the_positive_part_of_a_tangent_is_positive_and_keeps_a_positive_tangent)
{
  Eigen::Matrix2d squeezed = Eigen::Matrix2d::Identity();
  squeezed(0, 0)           = 0.4;
  const Eigen::Matrix4d A  = response(Law::green, some_stiffness(), squeezed).tangent;
  const auto smallest      = [](const Eigen::Matrix4d &m)
  { return meshes::symmetric_eigen<4>(m).values(0); };
  EXPECT_LT(smallest(A), -0.1);
  EXPECT_GT(smallest(positive_part(A)), -1e-14);
  const Eigen::Matrix4d B =
    response(Law::green, some_stiffness(), 1.1 * Eigen::Matrix2d::Identity()).tangent;
  EXPECT_LT((positive_part(B) - B).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(tripwire_laws, an_unknown_law_is_named)
{
  try
  {
    law_of("neo-hooke");
    FAIL();
  }
  catch (const meshes::BadInput &bad)
  {
    std::vector<std::string> names;
    for (const Law law : all_laws())
      names.push_back(name_of(law));
    EXPECT_EQ(std::string(bad.what()),
              "unknown reference `neo-hooke`; expected " + meshes::one_of(names));
  }
}
