// SPDX-License-Identifier: MIT
// How the time of a scene goes on: frames, and the steps between two of them. A frame is a whole
// number of steps and a run a whole number of frames; what a duration has beyond that is not run.
#pragma once

#include "verification/drape/scene/scene.h"

#include <limits>

namespace homespun::verification
{
struct DrapeSchedule
{
  /// @throws BadInput where the duration is shorter than a step
  explicit DrapeSchedule(const Scene &scene);

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

  /// The step over which held vertices are accelerated; infinity where nothing has inertia [s].
  double step_of_forces() const
  {
    return is_static ? std::numeric_limits<double>::infinity() : step;
  }

  /// What is run [s].
  double duration() const
  {
    return n_frames * interval;
  }

  const bool is_static; ///< an equilibrium per frame
  const double step;    ///< [s]
  const int steps_per_frame;
  const double interval; ///< [s]
  const int n_frames;    ///< after the first
};
} // namespace homespun::verification
