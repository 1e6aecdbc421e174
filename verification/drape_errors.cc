// SPDX-License-Identifier: MIT
#include "verification/drape_errors.h"

#include "meshes/errors.h"

#include <cmath>
#include <limits>

namespace homespun::verification
{
using meshes::SpacePoints;

namespace
{
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

SpacePoints upsampled(const DrapedCell &draped, const std::string &method,
                      const shell::Vectors &coarse)
{
  Upsampler3d::Fine fine;
  draped.upsampler<double>(Method(method)).upsample(coarse, fine);
  return fine;
}
} // namespace

double DrapeErrorBar::at(const std::size_t frame, const double fluctuation_there) const
{
  if (frame >= difference.size() || !(fluctuation[frame] > 0.))
    return not_known;
  return difference[frame] / fluctuation[frame] * fluctuation_there;
}

DrapeErrorBar drape_error_bar(const DrapedCell &draped, const Law law, const int n_cells,
                              const DrapeSchedule &schedule, const MPI_Comm communicator)
{
  const Scene small = scaled(draped.scene, n_cells);
  const DrapedCell sheet(small, draped.cell, draped.homogenized);
  const std::unique_ptr<FineRun> p1 = dealii_run(sheet, law, 1, communicator),
                                 p2 = dealii_run(sheet, law, 2, communicator);
  SceneCloth coarse(small, sheet.coarse, sheet.effective, sheet.coarse_motion());
  DrapeErrorBar bar;
  for (int frame = 0; frame <= schedule.n_frames; ++frame)
  {
    const double time = schedule.time_of(frame);
    for (int k = 0; k < schedule.steps_to(frame); ++k)
    {
      if (schedule.is_static)
        coarse.solve_equilibrium(time);
      else
        coarse.step(schedule.step);
      for (FineRun *const run : {p1.get(), p2.get()})
        if (!run->advance(schedule.is_static, schedule.step, time).why.empty())
          return bar;
    }
    const SpacePoints motion = upsampled(sheet, "affine", coarse.cloth().positions());
    bar.difference.push_back((p1->positions() - p2->positions()).rowwise().norm().mean());
    bar.fluctuation.push_back((p2->positions() - motion).rowwise().norm().mean());
  }
  return bar;
}

void compare(const DrapedCell &draped, const std::string &reference,
             const std::vector<std::string> &methods, const std::vector<CoarseRun> &runs,
             const int frame, const SpacePoints &positions, const DrapeErrorBar &bar,
             DrapeOutput &output)
{
  const auto at      = static_cast<std::size_t>(frame);
  double fluctuation = not_known;
  for (const CoarseRun &run : runs)
  {
    if (run.frames.size() <= at)
      continue;
    if (run.is_method())
    {
      fluctuation =
        (positions - upsampled(draped, "affine", run.frames[at])).rowwise().norm().mean();
      // Where nothing has moved yet, round-off over round-off is no figure.
      if (fluctuation < 1e-12 * draped.side)
        fluctuation = not_known;
    }
    for (const std::string &method : methods)
    {
      const SpacePoints up           = upsampled(draped, method, run.frames[at]);
      const Eigen::VectorXd distance = (up - positions).rowwise().norm();
      if (!distance.allFinite())
        throw meshes::NotConverged(draped.cell.name + ", " + run.variant + ", " + method +
                                     ": positions that are not finite",
                                   {});
      output.write_error(draped.cell.name, run.variant, reference, method, frame,
                         {distance.mean(),
                          std::sqrt(distance.squaredNorm() / static_cast<double>(distance.size())),
                          distance.maxCoeff(), distance.mean() / draped.side,
                          distance.mean() / fluctuation, bar.at(at, fluctuation)});
      if (run.is_method() && method == "localized" && output.has_frames())
      {
        std::vector<meshes::VertexData> data = draped.fine_data();
        data.push_back({"error", distance.cast<float>()});
        output.write_frame(draped.cell.name + "-" + run.variant, "fine", frame, up.cast<float>(),
                           draped.fine_triangles(), data, nullptr);
      }
    }
  }
}
} // namespace homespun::verification
