// SPDX-License-Identifier: MIT
#include "verification/record/step_times.h"

#include <gtest/gtest.h>

#include <cmath>

namespace homespun::verification
{
namespace
{
TEST(exact_step_times, of_a_hundred_steps_five_are_longer_than_the_percentile)
{
  std::vector<double> seconds;
  for (int k = 100; k >= 1; --k)
    seconds.push_back(k);
  const StepTimes times = step_times(seconds);
  EXPECT_DOUBLE_EQ(times.mean, 50.5);
  EXPECT_DOUBLE_EQ(times.median, 50.5);
  EXPECT_DOUBLE_EQ(times.percentile_95, 95.);
}

TEST(exact_step_times, a_few_long_steps_move_the_mean_and_the_percentile_and_not_the_median)
{
  std::vector<double> seconds(30, 1.);
  seconds[3] = seconds[17] = 16.;
  const StepTimes times    = step_times(seconds);
  EXPECT_DOUBLE_EQ(times.median, 1.);
  EXPECT_DOUBLE_EQ(times.mean, 2.);
  EXPECT_DOUBLE_EQ(times.percentile_95, 16.); // the 29th of 30
  seconds[3] = 1.;
  EXPECT_DOUBLE_EQ(step_times(seconds).percentile_95, 1.);
}

TEST(exact_step_times, of_one_step_all_are_its_time_and_of_none_nothing_is_known)
{
  const StepTimes one = step_times({3.});
  EXPECT_EQ(one.mean, 3.);
  EXPECT_EQ(one.percentile_95, 3.);
  EXPECT_TRUE(std::isnan(step_times({}).mean));
  EXPECT_TRUE(std::isnan(step_times({}).percentile_95));
}
} // namespace
} // namespace homespun::verification
