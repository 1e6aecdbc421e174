// SPDX-License-Identifier: MIT
#include "meshes/plain/gauss_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace homespun::meshes;

TEST(exact_gauss_rule, integrates_polynomials_of_degree_2n_minus_1_and_no_more)
{
  for (const int n : {1, 2, 3, 5, 14, 28})
  {
    const GaussRule rule = gauss_rule(n);
    const auto error     = [&](const int degree)
    {
      const double found = rule.points.array().pow(degree).matrix().dot(rule.weights);
      return std::abs(found - (degree % 2 == 0 ? 2. / (degree + 1.) : 0.));
    };
    // Weights sum to 2, each with the round-off of a recurrence of n steps.
    const double round_off = 2. * (n + 2) * std::numeric_limits<double>::epsilon();
    for (int degree = 0; degree < 2 * n; ++degree)
      EXPECT_LT(error(degree), round_off) << n << ' ' << degree;
    // What x^(2n) leaves is the square of the norm of P_n with leading coefficient 1,
    // 2^(2n+1) n!^4 / ((2n+1) (2n)!^2).
    const double left = std::exp((2. * n + 1.) * std::log(2.) + 4. * std::lgamma(n + 1.) -
                                 std::log(2. * n + 1.) - 2. * std::lgamma(2. * n + 1.));
    EXPECT_NEAR(error(2 * n), left, round_off + 1e-10 * left) << n;
    for (int i = 1; i < n; ++i)
      EXPECT_LT(rule.points(i - 1), rule.points(i));
  }
}
