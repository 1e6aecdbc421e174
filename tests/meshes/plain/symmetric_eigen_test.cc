// SPDX-License-Identifier: MIT
// Eigenvalues of two rows in closed form against QR iterations, which have those of three and four.
#include "meshes/plain/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace homespun::meshes;

// The vectors themselves are held against the matrix: of values that lie close QR's are others.
TEST(exact_symmetric_eigen, of_two_rows_values_and_vectors_are_those_of_the_matrix)
{
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> between(-1., 1.);
  for (int k = 0; k < 2000; ++k)
  {
    const double off = k % 5 == 0 ? 0. : std::pow(10., -(k % 17)) * between(generator);
    const double one = between(generator), other = k % 3 == 0 ? one : between(generator);
    Eigen::Matrix2d A;
    A << one, off, off, other;
    A *= std::pow(10., k % 11 - 5);
    const SymmetricEigen<2> found = symmetric_eigen<2>(A);
    const double size             = A.norm();
    EXPECT_LE(found.values(0), found.values(1));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> other_way(A);
    EXPECT_LE((found.values - other_way.eigenvalues()).norm(), 8. * epsilon * size);
    EXPECT_LE((A * found.vectors - found.vectors * found.values.asDiagonal()).norm(),
              8. * epsilon * size);
    EXPECT_LE((found.vectors.transpose() * found.vectors - Eigen::Matrix2d::Identity()).norm(),
              8. * epsilon);
  }
}

TEST(exact_symmetric_eigen, of_two_rows_of_which_one_is_tiny_the_small_value_keeps_its_digits)
{
  Eigen::Matrix2d A;
  A << 1., 1e-9, 1e-9, 3e-18; // whose determinant is 2e-18
  EXPECT_NEAR(symmetric_eigen<2>(A).values(0), 2e-18, 1e-31);
  EXPECT_EQ(symmetric_eigen<2>(Eigen::Matrix2d::Zero()).values.norm(), 0.);
  const Eigen::Matrix2d nothing =
    Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isnan(symmetric_eigen<2>(nothing).values(0)));
}
