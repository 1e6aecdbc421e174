// SPDX-License-Identifier: MIT
#include "verification/drape/drape_schedule.h"

#include "meshes/plain/errors.h"
#include "verification/record/fields.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
/// How often a part fits into a whole, both as decimal numbers that are not exact in binary.
int times_in(const double whole, const double part)
{
  return static_cast<int>(std::floor(whole / part * (1. + 1e-9) + 1e-9));
}

/// @return of a static scene 1
int checked_steps_per_frame(const Scene &scene)
{
  if (scene.integration == TimeIntegration::equilibria)
    return 1;
  const int most = times_in(scene.duration, scene.time_step);
  if (most < 1)
    throw meshes::BadInput(scene.file + ": key `Duration` (option --duration): found " +
                           short_text(scene.duration) + " s, with a time step of " +
                           short_text(scene.time_step) + " s; expected at least one step");
  const double wanted = std::round(scene.frame_interval / scene.time_step);
  return static_cast<int>(std::clamp(wanted, 1., static_cast<double>(most)));
}
} // namespace

DrapeSchedule::DrapeSchedule(const Scene &scene)
    : is_static(scene.integration == TimeIntegration::equilibria)
    , step(scene.time_step)
    , steps_per_frame(checked_steps_per_frame(scene))
    , interval(is_static ? std::min(scene.frame_interval, scene.duration) : steps_per_frame * step)
    , n_frames(times_in(scene.duration, interval))
{
}
} // namespace homespun::verification
