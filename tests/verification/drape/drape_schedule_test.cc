// SPDX-License-Identifier: MIT
#include "tests/refusal.h"
#include "verification/drape/drape_schedule.h"

#include <gtest/gtest.h>

#include <tuple>

using namespace homespun;
using namespace homespun::verification;

namespace
{
Scene scene_of(const double step, const double interval, const double duration)
{
  Scene scene;
  scene.file           = "scene.prm";
  scene.time_step      = step;
  scene.frame_interval = interval;
  scene.duration       = duration;
  return scene;
}
} // namespace

TEST(exact_drape_schedule, frames_and_steps_of_decimal_times_are_counted_without_loss)
{
  for (const auto &[step, interval, duration, steps, frames] :
       {std::tuple{0.01, 0.05, 1., 5, 20}, std::tuple{0.005, 0.03, 0.6, 6, 20},
        std::tuple{0.001, 0.1, 0.3, 100, 3}, std::tuple{1e-4, 1e-4, 1., 1, 10000}})
  {
    const DrapeSchedule schedule(scene_of(step, interval, duration));
    EXPECT_EQ(schedule.steps_per_frame, steps);
    EXPECT_EQ(schedule.n_frames, frames);
    EXPECT_NEAR(schedule.duration(), duration, 1e-12);
  }
}

TEST(invariant_drape_schedule, the_time_of_a_frame_is_that_of_its_steps)
{
  for (const double step : {0.01, 0.02, 0.007})
    for (const double interval : {0.01, 0.05, 0.3})
      for (const double duration : {0.02, 0.055, 0.1, 0.25, 1.})
      {
        const DrapeSchedule schedule(scene_of(step, interval, duration));
        int n_steps = 0;
        for (int frame = 0; frame <= schedule.n_frames; ++frame)
        {
          n_steps += schedule.steps_to(frame);
          EXPECT_NEAR(schedule.time_of(frame), n_steps * step, 1e-12);
        }
        EXPECT_GE(n_steps, 1) << step << ' ' << interval << ' ' << duration;
        EXPECT_NEAR(schedule.duration(), n_steps * step, 1e-12);
        EXPECT_LE(schedule.duration(), duration * (1. + 1e-8));
        // What is left out is less than a frame.
        EXPECT_GT(schedule.duration(), duration - schedule.interval - 1e-12);
      }
}

TEST(exact_drape_schedule, a_static_scene_has_an_equilibrium_per_frame_whatever_its_step)
{
  Scene scene       = scene_of(10., 0.05, 0.2);
  scene.integration = TimeIntegration::equilibria;
  const DrapeSchedule schedule(scene);
  EXPECT_EQ(schedule.steps_to(1), 1);
  EXPECT_EQ(schedule.n_frames, 4);
}

TEST(tripwire_drape_schedule, a_duration_without_a_step_is_refused_with_both_numbers)
{
  const std::string text = tests::refusal([] { DrapeSchedule(scene_of(0.01, 0.05, 0.004)); });
  for (const char *part : {"scene.prm", "`Duration`", "--duration", "0.004 s", "0.01 s"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}
