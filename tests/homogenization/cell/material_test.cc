// SPDX-License-Identifier: MIT
#include "homogenization/cell/material.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun::homogenization;

TEST(exact_material, the_compliance_of_a_brick_shows_each_of_its_constants_in_its_place)
{
  // Distinct constants, so that a swap of indices or a factor of two cannot hide.
  const Phase brick{"brick", 7., 3., 0.23, 1.7, 0., 0.5, 1.};
  const Eigen::Matrix3d S = plane_stress_stiffness(brick).inverse() * brick.thickness;
  EXPECT_NEAR(1. / S(0, 0), 7., 1e-13);
  EXPECT_NEAR(1. / S(1, 1), 3., 1e-13);
  EXPECT_NEAR(1. / S(2, 2), 1.7, 1e-13);
  EXPECT_NEAR(-S(0, 1) / S(0, 0), 0.23, 1e-13);
  EXPECT_NEAR(S(0, 2), 0., 1e-15);
}

TEST(exact_material, pulled_along_a_turned_fibre_the_modulus_is_that_of_the_fibre)
{
  const Phase yarn{"yarn", 10., 1., 0.3, 0.4, 30., 1., 1.};
  const Eigen::Matrix3d S = plane_stress_stiffness(yarn).inverse();
  const double c = std::cos(M_PI / 6.), s = std::sin(M_PI / 6.);
  const Eigen::Vector3d along(c * c, s * s, c * s); // stress of unit tension along the fibre
  EXPECT_NEAR(1. / along.dot(S * along), 10., 1e-12);
  // Under it the fibre's own axes do not shear, so the strain along it is 1/E1.
}

TEST(invariant_material, isotropic_phases_do_not_feel_their_angle)
{
  Phase phase             = isotropic("p", 3., 0.25, 2., 1.);
  const Eigen::Matrix3d c = plane_stress_stiffness(phase);
  phase.angle             = 37.;
  EXPECT_LT((plane_stress_stiffness(phase) - c).cwiseAbs().maxCoeff(), 1e-14 * c.maxCoeff());
}

TEST(invariant_material, plane_stress_stays_regular_at_incompressibility)
{
  for (const double nu : {-0.99, 0., 0.5, 0.999})
  {
    const Eigen::Matrix3d c = plane_stress_stiffness(isotropic("p", 1., nu, 1., 1.));
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(c).eigenvalues()(0), 0.) << nu;
    EXPECT_TRUE(faults_of(isotropic("p", 1., nu, 1., 1.)).empty()) << nu;
  }
}

TEST(tripwire_material, impossible_constants_are_named)
{
  const auto says = [](const Phase &phase, const std::string &text)
  {
    for (const std::string &fault : faults_of(phase))
      if (fault.find(text) != std::string::npos && fault.find("`p`") != std::string::npos)
        return true;
    return false;
  };
  EXPECT_TRUE(says(isotropic("p", -1., 0.3, 1., 1.), "Young's modulus -1 Pa"));
  EXPECT_TRUE(says(isotropic("p", 1., 1., 1., 1.), "Poisson's ratio 1"));
  EXPECT_TRUE(says(isotropic("p", 1., -1., 1., 1.), "Poisson's ratio -1"));
  EXPECT_TRUE(says(isotropic("p", 1., 0.3, 0., 1.), "thickness 0 m"));
  EXPECT_TRUE(says(isotropic("p", 1., 0.3, 1., -2.), "density -2 kg/m^3"));
  EXPECT_TRUE(says({"p", 1., 4., 0.6, 1., 0., 1., 1.}, "Poisson's ratio 0.6"));
  EXPECT_TRUE(says({"p", 1., 4., 0.3, -1., 0., 1., 1.}, "shear modulus -1 Pa"));
}
