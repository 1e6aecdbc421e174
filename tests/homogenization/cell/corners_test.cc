// SPDX-License-Identifier: MIT
#include "homogenization/cell/corners.h"
#include "tests/homogenization/bracket/bracket_cells.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
Corner free_wedge(const double angle, const Eigen::Matrix3d &stiffness)
{
  return {{{0.3, 0.3 + angle, stiffness}}, false};
}

std::vector<Corner> corners_of(const tests::BracketCell &cell)
{
  return homogenization::corners_of(cell.mesh, cell.lattice, cell.stiffness);
}

/// One quarter of one phase, three of another: the corner of a square inclusion.
Corner quarter(const double contrast)
{
  const auto phases = tests::contrasting(contrast);
  return {{{0.2, 0.2 + 0.5 * M_PI, phases[1]}, {0.2 + 0.5 * M_PI, 0.2 + 2. * M_PI, phases[0]}},
          true};
}
} // namespace

TEST(exact_corners, a_free_wedge_has_the_exponents_of_williams)
{
  // sin(lambda a) = −+ lambda sin(a); M. L. Williams, J. Appl. Mech. 19, 1952. Crack and right
  // angle.
  const Eigen::Matrix3d c = tests::isotropic_stiffness(3., 0.2);
  const auto right_angle  = exponents_of(free_wedge(1.5 * M_PI, c));
  ASSERT_GE(right_angle.size(), 2u);
  EXPECT_NEAR(right_angle[0], 0.544483737, 1e-8);
  EXPECT_NEAR(right_angle[1], 0.908529189, 1e-8);
  const auto crack = exponents_of(free_wedge(2. * M_PI, c));
  ASSERT_GE(crack.size(), 2u);
  EXPECT_NEAR(crack[0], 0.5, 1e-8);
  EXPECT_NEAR(crack[1], 0.5, 1e-8);
  // A crack has 1/2 in any anisotropic medium.
  const auto anisotropic = exponents_of(
    free_wedge(2. * M_PI, plane_stress_stiffness({"a", 10., 1., 0.3, 0.4, 30., 1., 1.})));
  EXPECT_NEAR(anisotropic[0], 0.5, 1e-4);
  EXPECT_NEAR(anisotropic[1], 0.5, 1e-4);
}

TEST(exact_corners, a_stiff_and_a_soft_inclusion_tend_to_a_clamped_and_to_a_free_wedge)
{
  const auto free = exponents_of(quarter(1e-8));
  EXPECT_NEAR(free[0], 0.544483737, 1e-5);
  // Clamped: (3 − nu)/(1 + nu) sin(lambda a) = −+ lambda sin(a) in plane stress (Williams).
  const auto clamped = exponents_of(quarter(1e8));
  const double a = 1.5 * M_PI, kappa = (3. - 0.3) / (1. + 0.3);
  EXPECT_NEAR(std::abs(kappa * std::sin(clamped[0] * a)), clamped[0] * std::abs(std::sin(a)), 1e-5);
  EXPECT_LT(clamped[0], 1.);
  // No contrast, no singularity.
  EXPECT_GT(exponents_of(quarter(1. + 1e-4))[0], 0.999);
}

TEST(exact_corners, a_corner_between_a_clamped_and_a_free_edge_has_the_exponents_of_williams)
{
  // kappa sin²(lambda a) = (kappa + 1)²/4 − lambda² sin²(a), kappa = (3 − nu)/(1 + nu) in plane
  // stress (Williams).
  const double kappa = (3. - 0.3) / (1. + 0.3);
  for (const double width : {0.4 * M_PI, 0.5 * M_PI, 0.6 * M_PI})
    for (const ClampedRay clamped : {ClampedRay::first, ClampedRay::last})
    {
      Corner corner       = free_wedge(width, tests::isotropic_stiffness(3., 0.3));
      corner.clamped      = clamped;
      const double lambda = exponents_of(corner).front();
      EXPECT_LT(lambda, 1.);
      EXPECT_NEAR(kappa * std::pow(std::sin(lambda * width), 2),
                  0.25 * std::pow(kappa + 1., 2) - std::pow(lambda * std::sin(width), 2), 1e-7)
        << width;
    }
}

TEST(exact_corners, a_stiff_square_in_a_soft_plane_has_the_roots_of_its_determinant)
{
  // Zeros of the 8 x 8 determinant of Muskhelishvili's potentials in both sectors, plane stress, nu
  // = 0.3, E 100 : 1.
  const Corner corner = {{{0., 0.5 * M_PI, tests::isotropic_stiffness(100., 0.3)},
                          {0.5 * M_PI, 2. * M_PI, tests::isotropic_stiffness(1., 0.3)}},
                         true};
  const auto found    = exponents_of(corner);
  ASSERT_GE(found.size(), 3u);
  EXPECT_NEAR(found[0], 0.632, 1e-3);
  EXPECT_NEAR(found[1], 0.749, 1e-3);
  EXPECT_NEAR(found[2], 1.200, 1e-3);
  EXPECT_NEAR(singularity_of({corner}).next, 1.200, 1e-3);
}

TEST(exact_corners, an_interface_that_bends_by_what_images_may_be_off_is_straight)
{
  // Vertices of the middle of stripes go up and down; an angle of 1e-4 is a corner, what a part of
  // 1e-8 of the side makes none.
  for (const auto &[shift, has_corners] : {std::pair{1e-8, false}, std::pair{1e-4, true}})
  {
    tests::BracketCell cell = tests::stripes(4, 4, 10.);
    for (int v = 0; v < cell.mesh.n_vertices(); ++v)
      if (std::abs(cell.mesh.vertices(v, 1) - 0.5) < 1e-9)
        cell.mesh.vertices(v, 1) += shift * std::cos(2. * M_PI * cell.mesh.vertices(v, 0));
    EXPECT_EQ(!corners_of(cell).empty(), has_corners) << shift;
  }
}

TEST(invariant_corners, turning_a_corner_or_its_units_changes_no_exponent)
{
  Corner corner     = quarter(30.);
  const auto before = exponents_of(corner);
  for (Sector &sector : corner.sectors)
  {
    sector.begin += 0.77, sector.end += 0.77;
    sector.stiffness *= 1e7;
  }
  const auto after = exponents_of(corner);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k)
    EXPECT_NEAR(after[k], before[k], 1e-8);
}

TEST(exact_corners, a_square_inclusion_has_four_a_checkerboard_two_and_a_laminate_none)
{
  EXPECT_EQ(corners_of(tests::square_inclusion_cell(8, 10.)).size(), 4u);
  EXPECT_TRUE(corners_of(tests::square_inclusion_cell(8, 1.)).empty());
  const auto checkerboard = corners_of(tests::checkerboard_cell(4, 1000.));
  EXPECT_EQ(checkerboard.size(), 4u); // all of its vertices, those on the outline once
  for (const Corner &corner : checkerboard)
    EXPECT_EQ(corner.sectors.size(), 4u);
  EXPECT_TRUE(corners_of(tests::stripes(4, 4, 10.)).empty());
  EXPECT_NEAR(singularity_of(checkerboard).strongest, 0.04, 0.01); // stress ~ r^(−0.96)
}

TEST(exact_corners, the_rim_of_a_square_hole_has_four_free_corners)
{
  tests::BracketCell cell = tests::square_inclusion_cell(8, 10.);
  int n_kept              = 0;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    if (cell.mesh.material(t) == 0)
      cell.mesh.triangles.row(n_kept++) = cell.mesh.triangles.row(t);
  cell.mesh.triangles.conservativeResize(n_kept, 3);
  cell.mesh.material.setZero(n_kept);
  const auto corners = corners_of(cell);
  ASSERT_EQ(corners.size(), 4u);
  for (const Corner &corner : corners)
    EXPECT_FALSE(corner.is_closed);
  const Singularity singularity = singularity_of(corners);
  EXPECT_NEAR(singularity.strongest, 0.544483737, 1e-7);
  EXPECT_NEAR(singularity.weakest, 0.908529189, 1e-7);
}
