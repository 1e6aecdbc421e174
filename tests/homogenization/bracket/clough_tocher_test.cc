// SPDX-License-Identifier: MIT
#include "homogenization/bracket/clough_tocher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using homespun::homogenization::CloughTocher;

namespace
{
using Corners          = std::array<Eigen::Vector2d, 3>;
const Corners triangle = {Eigen::Vector2d(0.1, -0.2), {1.3, 0.1}, {0.4, 0.9}};

Corners normals_of(const Corners &corners)
{
  Corners normals;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Eigen::Vector2d side = corners[(k + 1) % 3] - corners[k];
    normals[k]                 = Eigen::Vector2d(side(1), -side(0)) / side.norm();
  }
  return normals;
}

/// A function by (f, f_x, f_y, f_xx, f_yy, f_xy) at a point.
using Jet = Eigen::Matrix<double, 6, 1>;

Jet monomial(const int i, const int j, const Eigen::Vector2d &p)
{
  const auto power = [](const double x, const int n, const int d)
  {
    double factor = 1.;
    for (int k = 0; k < d; ++k)
      factor *= n - k;
    return n < d ? 0. : factor * std::pow(x, n - d);
  };
  const auto d = [&](const int a, const int b) { return power(p(0), i, a) * power(p(1), j, b); };
  Jet jet;
  jet << d(0, 0), d(1, 0), d(0, 1), d(2, 0), d(0, 2), d(1, 1);
  return jet;
}

Jet wave(const Eigen::Vector2d &p)
{
  const double x = 2. * p(0) + 0.3, y = 3. * p(1) - 0.2;
  Jet jet;
  jet << std::sin(x) * std::cos(y), 2. * std::cos(x) * std::cos(y), -3. * std::sin(x) * std::sin(y),
    -4. * std::sin(x) * std::cos(y), -9. * std::sin(x) * std::cos(y),
    -6. * std::cos(x) * std::sin(y);
  return jet;
}

template <typename Function>
Eigen::Matrix<double, 12, 1> interpolated(const Corners &corners, const Function &function)
{
  Eigen::Matrix<double, 12, 1> values;
  const Corners normals = normals_of(corners);
  for (int k = 0; k < 3; ++k)
  {
    const auto here          = static_cast<std::size_t>(k);
    values.segment<3>(3 * k) = function(corners[here]).template head<3>();
    const Jet middle         = function(0.5 * (corners[here] + corners[(here + 1) % 3]));
    values(9 + k)            = middle.segment<2>(1).dot(normals[here]);
  }
  return values;
}

Eigen::Vector2d point_of(const Corners &corners, const int piece, const Eigen::Vector3d &u)
{
  const auto k                   = static_cast<std::size_t>(piece);
  const Eigen::Vector2d centroid = (corners[0] + corners[1] + corners[2]) / 3.;
  return u(0) * corners[k] + u(1) * corners[(k + 1) % 3] + u(2) * centroid;
}

const Eigen::Vector3d some_points[] = {{0.2, 0.3, 0.5},
                                       {0.7, 0.2, 0.1},
                                       {1., 0., 0.},
                                       {0., 0., 1.},
                                       {0.4, 0.6, 0.}};
} // namespace

TEST(exact_clough_tocher, all_cubics_are_reproduced_with_their_derivatives)
{
  const CloughTocher element(triangle, normals_of(triangle));
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; i + j <= 3; ++j)
    {
      const auto values =
        interpolated(triangle, [&](const Eigen::Vector2d &p) { return monomial(i, j, p); });
      for (int piece = 0; piece < 3; ++piece)
        for (const Eigen::Vector3d &u : some_points)
        {
          Jet found;
          found << element.value_and_gradient(piece, u) * values,
            element.second_derivatives(piece, u) * values;
          EXPECT_LT((found - monomial(i, j, point_of(triangle, piece, u))).norm(), 1e-12)
            << "x^" << i << " y^" << j;
        }
    }
}

TEST(exact_clough_tocher, the_degrees_of_freedom_are_those_they_are_called)
{
  const CloughTocher element(triangle, normals_of(triangle));
  Eigen::Matrix<double, 12, 12> found;
  for (int k = 0; k < 3; ++k)
  {
    found.middleRows<3>(3 * k) = element.value_and_gradient(k, {1., 0., 0.});
    found.row(9 + k)           = normals_of(triangle)[static_cast<std::size_t>(k)].transpose() *
                       element.value_and_gradient(k, {0.5, 0.5, 0.}).bottomRows<2>();
  }
  EXPECT_LT((found - Eigen::Matrix<double, 12, 12>::Identity()).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(exact_clough_tocher, value_and_gradient_are_continuous_inside_and_across_a_side)
{
  std::mt19937 generator(5);
  std::normal_distribution<double> random;
  Eigen::Matrix<double, 12, 1> mine, other;
  for (double &value : mine)
    value = random(generator);
  for (double &value : other)
    value = random(generator);
  const CloughTocher element(triangle, normals_of(triangle));
  for (int piece = 0; piece < 3; ++piece)
    for (const double s : {0.1, 0.5, 0.8, 1.})
      EXPECT_LT((element.value_and_gradient(piece, {1. - s, 0., s}) * mine -
                 element.value_and_gradient((piece + 2) % 3, {0., 1. - s, s}) * mine)
                  .norm(),
                1e-12);

  // The neighbour beyond side 1 has it as its side 0, run the other way, and sees the same normal.
  const Corners beyond = {triangle[2], triangle[1], Eigen::Vector2d(1.5, 1.4)};
  Corners its_normals  = normals_of(beyond);
  its_normals[0]       = normals_of(triangle)[1];
  other.segment<3>(0)  = mine.segment<3>(6);
  other.segment<3>(3)  = mine.segment<3>(3);
  other(9)             = mine(10);
  const CloughTocher neighbour(beyond, its_normals);
  for (const double s : {0., 0.2, 0.5, 0.9})
    EXPECT_LT((element.value_and_gradient(1, {1. - s, s, 0.}) * mine -
               neighbour.value_and_gradient(0, {s, 1. - s, 0.}) * other)
                .norm(),
              1e-12);
}

TEST(order_clough_tocher, interpolation_errs_by_h4_in_value_and_h2_in_the_second_derivatives)
{
  const Eigen::Vector2d centre(0.37, 0.21);
  double before_value = 0., before_second = 0.;
  for (int level = 0; level < 5; ++level)
  {
    const double h  = 0.2 * std::pow(0.5, level);
    Corners corners = triangle;
    for (Eigen::Vector2d &corner : corners)
      corner = centre + h * corner;
    const CloughTocher element(corners, normals_of(corners));
    const auto values = interpolated(corners, wave);
    double of_value = 0., of_second = 0.;
    for (int piece = 0; piece < 3; ++piece)
      for (const Eigen::Vector3d &u : some_points)
      {
        const Jet exact = wave(point_of(corners, piece, u));
        of_value        = std::max(
                 of_value, std::abs((element.value_and_gradient(piece, u) * values)(0) - exact(0)));
        of_second = std::max(
          of_second, (element.second_derivatives(piece, u) * values - exact.tail<3>()).norm());
      }
    if (level > 1)
    {
      EXPECT_NEAR(std::log2(before_value / of_value), 4., 0.15) << level;
      EXPECT_NEAR(std::log2(before_second / of_second), 2., 0.15) << level;
    }
    before_value  = of_value;
    before_second = of_second;
  }
}
