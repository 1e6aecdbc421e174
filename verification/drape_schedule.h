// SPDX-License-Identifier: MIT
// How the time of a scene goes on: frames, and the steps between two of them.
#pragma once

#include "verification/scene.h"

#include <cmath>

namespace homespun::verification
{
struct DrapeSchedule
{
  explicit DrapeSchedule(const Scene &scene)
      : is_static(scene.integration == TimeIntegration::equilibria)
      , step(scene.time_step)
      , interval(scene.frame_interval)
      , n_frames(static_cast<int>(std::floor(scene.duration / scene.frame_interval + 1e-9)))
      , steps_per_frame(
          is_static ? 1 : static_cast<int>(std::lround(scene.frame_interval / scene.time_step)))
  {
  }

  /// Steps, or equilibria, that lead to a frame from the one before; the first is the beginning.
  int steps_to(const int frame) const
  {
    return frame == 0 ? 0 : steps_per_frame;
  }

  /// [s]
  double time_of(const int frame) const
  {
    return frame * interval;
  }

  const bool is_static;  ///< an equilibrium per frame
  const double step;     ///< [s]
  const double interval; ///< [s]
  const int n_frames;    ///< after the first
  const int steps_per_frame;
};
} // namespace homespun::verification
