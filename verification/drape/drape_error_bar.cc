// SPDX-License-Identifier: MIT
#include "verification/drape/drape_error_bar.h"

#include "meshes/plain/errors.h"
#include "verification/drape/fine_run.h"
#include "verification/record/verdict.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace homespun::verification
{
namespace
{
using meshes::SpacePoints;

double mean_length(const SpacePoints &field)
{
  return field.rowwise().norm().mean();
}

SpacePoints upsampled(const Upsampler3d &upsampler, const shell::Vectors &coarse)
{
  Upsampler3d::Fine fine;
  upsampler.upsample(coarse, fine);
  return fine;
}

/// A coarse cloth and resolved ones that go side by side with one time step.
class Runs
{
public:
  /// @param step [s]
  /// @param n_steps of the schedule's steps that one of its steps is made of
  Runs(const Scene &scene, const DrapedCell &sheet, const double step, const int n_steps)
      : step(step)
      , n_steps(n_steps)
      , coarse(scene, sheet.coarse, sheet.effective, sheet.coarse_motion())
  {
  }

  /// @return whether all of them came to the next frame
  bool advance(const DrapeSchedule &schedule, const int frame)
  {
    const double time = schedule.time_of(frame);
    for (int k = 0; k < n_steps * schedule.steps_to(frame); ++k)
    {
      // Every rank has the same coarse cloth, and they end together.
      try
      {
        if (schedule.is_static)
          coarse.solve_equilibrium(time);
        else
          coarse.step(step);
      }
      catch (const meshes::NotConverged &)
      {
        return false;
      }
      for (const std::unique_ptr<FineRun> &run : fine)
        if (!run->advance(schedule.is_static, step, time).why.empty())
          return false;
    }
    return true;
  }

  const double step;
  const int n_steps;
  SceneCloth coarse;
  std::vector<std::unique_ptr<FineRun>> fine;
};

/// The largest up to a frame of what a bar is carried over with, and of the bar; not a number where
/// that frame was not reached.
template <typename BarOf>
double carried(const DrapeErrorBar &bar, const std::size_t frame, const double largest_there,
               const BarOf &bar_of)
{
  if (frame >= bar.fluctuation.size())
    return std::numeric_limits<double>::quiet_NaN();
  double largest = 0., fluctuation = 0.;
  for (std::size_t k = 0; k <= frame; ++k)
  {
    largest     = larger(largest, bar_of(k));
    fluctuation = larger(fluctuation, bar.fluctuation[k]);
  }
  return fluctuation > 0. ? largest / fluctuation * largest_there
                          : std::numeric_limits<double>::quiet_NaN();
}
} // namespace

double DrapeErrorBar::of_coarse_step_at(const std::size_t frame) const
{
  if (frame >= coarse_step.size())
    return std::numeric_limits<double>::quiet_NaN();
  return 1.25 * 2. * *std::max_element(coarse_step.begin(), coarse_step.begin() + frame + 1);
}

double DrapeErrorBar::of_mesh_at(const std::size_t frame, const double largest_there) const
{
  return carried(*this, frame, largest_there,
                 [this](const std::size_t k) { return meshes[k].uncertainty(order); });
}

double DrapeErrorBar::of_time_step_at(const std::size_t frame, const double largest_there) const
{
  return carried(*this, frame, largest_there,
                 [this](const std::size_t k) { return 1.25 * 2. * halved_step[k]; });
}

DrapeErrorBar drape_error_bar(const DrapedCell &draped, const Law law, const int n_cells,
                              const DrapeSchedule &schedule, const MPI_Comm communicator,
                              const std::function<void(int frame)> &tell)
{
  const Scene scene = scaled(draped.scene, n_cells);
  const DrapedCell sheet(scene, draped.cell, draped.homogenized, draped.law);
  const Upsampler3d affine = sheet.upsampler<double>(Method("affine")),
                    method = sheet.upsampler<double>(Method("localized"));

  Runs runs(scene, sheet, schedule.step, 1), halved(scene, sheet, 0.5 * schedule.step, 2);
  for (const Discretization &discretization : {Discretization{1, 0}, {2, 0}, {2, 1}})
    runs.fine.push_back(dealii_run(sheet, law, discretization, communicator));
  halved.fine.push_back(dealii_run(sheet, law, {1, 0}, communicator));

  DrapeErrorBar bar;
  bar.order = order_of_p2(draped.cell, order_of_p2_sheet);
  for (int frame = 0; frame <= schedule.n_frames; ++frame)
  {
    tell(frame);
    if (!runs.advance(schedule, frame) || (!schedule.is_static && !halved.advance(schedule, frame)))
      return bar;
    const SpacePoints &p1 = runs.fine[0]->positions(), &p2 = runs.fine[1]->positions(),
                      &refined = runs.fine[2]->positions();
    bar.meshes.push_back(
      {mean_length(p1 - p2), mean_length(p1 - refined), mean_length(p2 - refined), true});
    const shell::Vectors &coarse = runs.coarse.cloth().positions();
    const SpacePoints change =
      (upsampled(method, coarse) - p1) -
      (upsampled(method, halved.coarse.cloth().positions()) - halved.fine[0]->positions());
    bar.halved_step.push_back(schedule.is_static ? 0. : mean_length(change));
    bar.fluctuation.push_back(mean_length(refined - upsampled(affine, coarse)));
  }
  return bar;
}

std::vector<double> changes_by_halved_step(const DrapedCell &draped,
                                           const std::vector<shell::Vectors> &frames,
                                           const DrapeSchedule &schedule)
{
  if (schedule.is_static)
    return std::vector<double>(frames.size(), 0.);
  const Upsampler3d method = draped.upsampler<double>(Method("localized"));
  Runs halved(draped.scene, draped, 0.5 * schedule.step, 2);
  std::vector<double> changes;
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
  {
    if (!halved.advance(schedule, static_cast<int>(frame)))
      break;
    changes.push_back(mean_length(upsampled(method, frames[frame]) -
                                  upsampled(method, halved.coarse.cloth().positions())));
  }
  return changes;
}
} // namespace homespun::verification
