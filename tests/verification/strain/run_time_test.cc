// SPDX-License-Identifier: MIT
#include "verification/record/timing.h"
#include "verification/strain/run_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace homespun::verification;

TEST(exact_run_time, the_median_is_the_middle)
{
  EXPECT_EQ(median({3., 1., 2.}), 2.);
  EXPECT_EQ(median({4., 1., 2., 3.}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(exact_run_time, the_bar_of_the_best_solution_is_carried_to_the_full_sheet)
{
  const std::string of             = UncertaintyRow::of_reference;
  std::vector<UncertaintyRow> rows = {
    {"cell", "strip-2", "linear", 0.001, 4, of, 2e-9, 3e-9, 1e-10},
    {"cell", "strip-2", "linear", 0.001, 20, of, 1e-9},
    {"cell", "strip-2", "biot", 0.05, 4, of, 1e-7, 1e-7, 2e-8}};
  // Of order q what is left of P2 is the sum of a geometric series, here 1 + 1/2 + ... of order 1.
  EXPECT_NEAR(bar_of_p2(rows, {"cell", "strip-2", Law::biot, 0.1}, 20, 1.),
              1.25 * 2. * 2e-8 / 0.05 * 0.5 * 0.1, 1e-15);
  EXPECT_TRUE(std::isnan(bar_of_p2(rows, {"cell", "strip-1", Law::biot, 0.1}, 20, 1.)));
  rows[2].p2_to_refined = 2e-7; // which does not fall along the ladder
  EXPECT_NEAR(bar_of_p2(rows, {"cell", "strip-2", Law::biot, 0.1}, 20, 1.),
              3. * 2. * 2e-7 / 0.05 * 0.5 * 0.1, 1e-15);
}
