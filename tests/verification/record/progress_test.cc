// SPDX-License-Identifier: MIT
#include "verification/record/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

using namespace homespun::verification;

TEST(bound_progress, a_bar_grows_with_time_and_stays_within_its_step)
{
  for (const double mean : {0., 0.1, 100.})
  {
    double before = -1.;
    for (const double seconds : {0., 0.01, 1., 30., 1e3, 1e6})
    {
      const double part = shown_part(3, 8, seconds, mean);
      EXPECT_GE(part, before);
      EXPECT_GE(part, 3. / 8.);
      EXPECT_LT(part, 4. / 8.);
      before = part;
    }
    EXPECT_GT(before, 3.9 / 8.);
  }
  EXPECT_EQ(shown_part(3, 8, 0., 1.), 3. / 8.);
  EXPECT_EQ(shown_part(8, 8, 5., 1.), 1.);
  EXPECT_EQ(shown_part(0, 0, 5., 1.), 0.);
}

TEST(exact_progress, a_step_that_takes_long_is_told_about_without_a_terminal)
{
  using std::chrono::milliseconds;
  testing::internal::CaptureStderr();
  {
    Progress progress(true, 4, std::chrono::duration<double>(0.05));
    progress.milestone("a long step");
    std::this_thread::sleep_for(milliseconds(400));
    progress.done();
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("[  0%] a long step\n"), std::string::npos) << told;
  EXPECT_NE(told.find("a long step: 0 s so far\n"), std::string::npos) << told;
}

TEST(exact_progress, nothing_is_told_when_quiet)
{
  testing::internal::CaptureStderr();
  {
    Progress progress(false, 4, std::chrono::duration<double>(0.01));
    progress.milestone("a step");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress.note("a note");
    progress.done();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}
