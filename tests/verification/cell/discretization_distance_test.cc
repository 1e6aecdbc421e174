// SPDX-License-Identifier: MIT
// The error bar from P1, P2 and refined P2 on numbers whose limit is known, zero.
#include "verification/cell/discretization_distance.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun::verification;

namespace
{
DiscretizationDistance distances(const double p1, const double p2, const double refined)
{
  return {std::abs(p1 - p2), std::abs(p1 - refined), std::abs(p2 - refined), true};
}
} // namespace

TEST(bound_discretization_distance, covers_an_error_whose_p2_falls_with_its_order)
{
  for (const double order : {1., 1.5, 2., 3.})
    for (const double p2 : {0.01, 0.1, 0.5, 0.9})
    {
      const double bar = distances(1., p2, p2 / std::pow(2., order)).uncertainty(order);
      EXPECT_GT(bar, 1.) << "order " << order << ", P2 " << p2;
      EXPECT_LT(bar, 4.) << "order " << order << ", P2 " << p2;
    }
}

// Of yarns a thousand times as stiff as their ground P2 is hardly nearer than P1, and refining it
// does more: the order of the corners is not reached.
TEST(bound_discretization_distance, covers_an_error_that_falls_more_slowly_than_it_should)
{
  EXPECT_GT(distances(0.60, 0.55, 0.30).uncertainty(3.), 0.60);
  EXPECT_GT(distances(0.554, 0.42, 0.183).uncertainty(1.42), 0.554);
}
