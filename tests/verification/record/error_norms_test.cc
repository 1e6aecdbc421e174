// SPDX-License-Identifier: MIT
#include "verification/record/error_norms.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun::verification;

TEST(exact_error_norms, of_three_four_and_five_by_hand)
{
  const ErrorNorms norms = error_norms(Eigen::Vector4d(3., 4., 5., 0.));
  EXPECT_DOUBLE_EQ(norms.mean, 3.);
  EXPECT_DOUBLE_EQ(norms.rms, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(norms.max, 5.);
}

// Millimetres are a thousand times as many metres.
TEST(invariant_error_norms, have_the_unit_of_the_distances)
{
  const Eigen::VectorXd metres = Eigen::Vector3d(0.1, 0.7, 0.3);
  const ErrorNorms in_metres = error_norms(metres), in_millimetres = error_norms(1e3 * metres);
  EXPECT_NEAR(in_millimetres.mean, 1e3 * in_metres.mean, 1e-12);
  EXPECT_NEAR(in_millimetres.rms, 1e3 * in_metres.rms, 1e-12);
  EXPECT_NEAR(in_millimetres.max, 1e3 * in_metres.max, 1e-12);
}
