// SPDX-License-Identifier: MIT
// A triangle at rest: its area and what is linear on it.
#include "meshes/plain/triangle_kinematics.h"

#include <gtest/gtest.h>

using namespace homespun::meshes;

TEST(exact_triangle_geometry, the_gradient_of_a_linear_field_is_that_of_its_corners)
{
  const Eigen::Vector2d slope(0.7, -1.3), first(3., -2.);
  Eigen::Matrix2d sides;
  sides << 0.4, -0.1, 0.05, 0.3; // columns from the first corner
  const TriangleGeometry of = triangle_geometry(sides);
  EXPECT_NEAR(of.area, 0.5 * (0.4 * 0.3 + 0.1 * 0.05), 1e-16);
  const Eigen::Vector3d values(slope.dot(first), slope.dot(first + sides.col(0)),
                               slope.dot(first + sides.col(1)));
  EXPECT_LT((of.shape_gradients.transpose() * values - slope).norm(), 1e-14);
  EXPECT_LT(of.shape_gradients.colwise().sum().norm(), 1e-15);
}

TEST(exact_triangle_geometry, a_triangle_that_runs_clockwise_has_a_negative_area)
{
  Eigen::Matrix2d sides;
  sides << 0., 1., 1., 0.;
  EXPECT_DOUBLE_EQ(triangle_geometry(sides).area, -0.5);
}
