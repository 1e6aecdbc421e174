// SPDX-License-Identifier: MIT
#include "meshes/plain/triangle_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace homespun::meshes;

namespace
{
/// So high over an edge of length 1, with the foot of the height at a part of it.
Eigen::Matrix<double, 3, 2> needle(const double height, const double foot)
{
  Eigen::Matrix<double, 3, 2> corners;
  corners << 0., 0., 1., 0., foot, height;
  return corners;
}

template <int dim>
bool has_area(const Eigen::Matrix<double, 3, dim> &corners)
{
  return triangle_area<dim>(corners).is_there();
}
} // namespace

TEST(exact_triangle_area, areas_and_heights_are_those_of_known_triangles)
{
  Eigen::Matrix<double, 3, 2> pythagoras;
  pythagoras << 1., 1., 4., 1., 1., 5.;
  EXPECT_DOUBLE_EQ(triangle_area<2>(pythagoras).area, 6.);
  EXPECT_DOUBLE_EQ(triangle_area<2>(pythagoras).longest_edge, 5.);
  EXPECT_DOUBLE_EQ(triangle_area<2>(pythagoras).height(), 12. / 25.);
  pythagoras.row(1).swap(pythagoras.row(2));
  EXPECT_DOUBLE_EQ(triangle_area<2>(pythagoras).area, -6.);
  EXPECT_TRUE(has_area<2>(pythagoras));
  Eigen::Matrix3d regular = Eigen::Matrix3d::Identity();
  EXPECT_DOUBLE_EQ(triangle_area<3>(regular).height(), 0.5 * std::sqrt(3.));
  EXPECT_EQ(triangle_area<3>(Eigen::Matrix3d::Ones()).height(), 0.);
  EXPECT_FALSE(has_area<3>(Eigen::Matrix3d::Ones()));
  regular(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(has_area<3>(regular));
}

TEST(invariant_triangle_area, neither_unit_nor_direction_nor_order_decides)
{
  for (const double foot : {-0.3, 0., 0.2, 0.5, 1.})
    for (const bool is_above : {true, false})
    {
      // A height over an edge that is not the longest is compared with the longest.
      const double longest = std::max({1., std::abs(foot), 1. - foot});
      const auto corners   = needle((is_above ? 1.1e-9 : 0.9e-9) * longest * longest, foot);
      for (int turn = 0; turn < 12; ++turn)
        for (const double unit : {1e-9, 1e-3, 1., 1e6})
        {
          const double angle = M_PI * turn / 6.;
          Eigen::Matrix2d R;
          R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
          Eigen::Matrix<double, 3, 2> turned = unit * corners * R.transpose();
          Eigen::Matrix3d in_space           = Eigen::Matrix3d::Zero();
          in_space.leftCols<2>()             = turned;
          for (int corner = 0; corner < 3; ++corner)
          {
            EXPECT_EQ(has_area<2>(turned), is_above) << foot << ' ' << turn << ' ' << unit;
            EXPECT_EQ(has_area<3>(in_space), is_above) << foot << ' ' << turn << ' ' << unit;
            turned.row(corner).swap(turned.row((corner + 1) % 3));
            in_space.row(corner).swap(in_space.row((corner + 1) % 3));
          }
        }
    }
}

// The error that the limit rests on: of the area of a triangle whose corners are rounded.
TEST(bound_triangle_area, corners_in_doubles_leave_the_area_an_error_of_4_eps_over_the_height)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> random(0., 1.);
  for (const double height : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9})
  {
    double worst = 0.; // of eps / height
    for (int k = 0; k < 10000; ++k)
    {
      const long double angle = 2.L * static_cast<long double>(M_PI * random(generator)),
                        foot  = static_cast<long double>(random(generator));
      Eigen::Matrix<long double, 3, 2> exact;
      exact << 0.L, 0.L, 1.L, 0.L, foot, static_cast<long double>(height);
      Eigen::Matrix<long double, 2, 2> R;
      R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
      exact *= R.transpose();
      const TriangleArea found = triangle_area<2>(exact.cast<double>());
      worst                    = std::max(worst, std::abs(2. * found.area / height - 1.) * height /
                                                   std::numeric_limits<double>::epsilon());
    }
    EXPECT_LT(worst, 4.) << height;
    EXPECT_GT(worst, 0.4) << height; // the bound is no idle one
  }
}
