// SPDX-License-Identifier: MIT
// The worst triangle of a state that is known, and the stress there by the closed form of the law.
#include "verification/ellipticity/worst_triangle.h"

#include "meshes/plain/sheet.h"
#include "meshes/plain/triangle_kinematics.h"
#include "verification/ellipticity/ellipticity.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// Two triangles of a square beside each other, the second of another phase.
meshes::TriangleMesh two_triangles()
{
  meshes::TriangleMesh mesh = meshes::coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), 1, 1);
  mesh.material << 0, 1;
  return mesh;
}

Eigen::Matrix3d orthotropic(const double shear)
{
  return Eigen::Vector3d(40., 40., shear).asDiagonal();
}
} // namespace

// green in uniaxial compression, Poisson's ratio 0: S11 = E (l² − 1)/2, lost at S11 = −G.
TEST(exact_worst_triangle, it_is_the_one_of_the_softer_shear_with_the_stress_of_the_law)
{
  const meshes::TriangleMesh rest              = two_triangles();
  const std::vector<Eigen::Matrix3d> stiffness = {orthotropic(10.), orthotropic(1.)};
  for (const double stretch : {0.99, 0.96})
  {
    meshes::Points positions = rest.vertices;
    positions.col(0) *= stretch;
    const WorstTriangle worst = worst_triangle(rest, stiffness, Law::green, positions);
    const double stress       = 20. * (stretch * stretch - 1.);
    EXPECT_EQ(worst.triangle, 1);
    EXPECT_NEAR(worst.stress(0), stress, 1e-12);
    EXPECT_NEAR(worst.stress(1), 0., 1e-12);
    EXPECT_NEAR(worst.least, 1. + stress, 1e-9); // (G + S11)/G
    EXPECT_EQ(worst.least > 0., stretch > 0.97);
    EXPECT_EQ(stress_text(worst).rfind("is pressed (", 0), 0u) << stress_text(worst);
  }
}

TEST(exact_worst_triangle, words_tell_a_pull_from_a_press_from_both)
{
  const auto text = [](const double smaller, const double larger)
  {
    WorstTriangle worst;
    worst.stress << smaller, larger;
    return stress_text(worst).substr(0, stress_text(worst).find(" ("));
  };
  EXPECT_EQ(text(0., 1.), "is pulled");
  EXPECT_EQ(text(-1e-9, 1.), "is pulled");
  EXPECT_EQ(text(-0.02, 1.), "is pulled and pressed");
  EXPECT_EQ(text(-1., 1e-9), "is pressed");
  EXPECT_EQ(text(-1., 2.), "is pulled and pressed");
  EXPECT_EQ(text(0., 0.), "is without stress");
}

// Both triangles are a turned and stretched whole.
TEST(exact_worst_triangle, the_gradient_of_an_affine_motion_is_that_motion)
{
  const meshes::TriangleMesh rest = two_triangles();
  Eigen::Matrix2d F;
  F << 1.1, 0.3, -0.2, 0.9;
  const meshes::Points positions = rest.vertices * F.transpose();
  for (const int t : {0, 1})
    EXPECT_LT((meshes::deformation_gradient<2>(rest, t, positions) - F).norm(), 1e-14);
}
