// SPDX-License-Identifier: MIT
#include "verification/coarse_run.h"

#include "meshes/errors.h"
#include "verification/verdict.h"

#include <filesystem>

namespace homespun::verification
{
namespace
{
/// A cloth ten thousand times its size away from where it began has blown up: pictures and curves of it
/// would show nothing else.
void check_reach(const shell::Vectors &positions, const shell::Vectors &start, const double time)
{
  constexpr double reach = 1e4;
  const double size      = (start.colwise().maxCoeff() - start.colwise().minCoeff()).maxCoeff();
  Eigen::Index vertex    = 0;
  const double moved     = (positions - start).rowwise().norm().maxCoeff(&vertex);
  if (moved > reach * size)
    throw meshes::NotConverged("the motion blows up: at " + csv_number(time) + " s vertex " +
                                 std::to_string(vertex) + " is " + csv_number(moved) +
                                 " m from where it began, the cloth being " + csv_number(size) +
                                 " m large; try a smaller time step",
                               {});
}

/// Time per step and memory of a scene with terms forced upon it.
std::pair<double, std::size_t> cost(const DrapedCell &draped, const std::set<std::string> &forced)
{
  constexpr int n_steps = 60;
  SceneCloth moving(draped.scene, draped.coarse, draped.effective, draped.coarse_motion(),
                    MembraneModel::corotational, forced);
  std::vector<double> seconds;
  for (int k = 0; k < n_steps; ++k)
    seconds.push_back(seconds_of([&]() { moving.step(draped.scene.time_step); }));
  return {median(seconds), moving.cloth().bytes()};
}
} // namespace

CoarseRun run_coarse(const DrapedCell &draped, const std::string &variant,
                     const DrapeSchedule &schedule, DrapeOutput &output, Progress &progress)
{
  CoarseRun run;
  run.variant                 = variant;
  const std::string name      = draped.cell.name + "-" + variant;
  const std::string folder    = output.folder + "/" + name;
  const Upsampler3f upsampler = draped.upsampler<float>(Method("localized"));
  std::filesystem::create_directories(folder);
  meshes::FrameCollection coarse_list(folder + "/coarse.pvd"), fine_list(folder + "/fine.pvd");
  std::vector<double> step_seconds, upsampling_seconds;
  int cuts = 0;
  Upsampler3f::Fine fine;
  SceneCloth moving(draped.scene, draped.coarse, draped.effective, draped.coarse_motion(),
                    membrane_model_of(variant));
  const auto upsample = [&]() { upsampler.upsample(moving.cloth().positions(), fine); };
  for (int frame = 0; frame <= schedule.n_frames; ++frame)
  {
    progress.begin(draped.cell.name + ", " + variant + " cloth, frame " + std::to_string(frame));
    try
    {
      for (int k = 0; k < schedule.steps_to(frame); ++k)
      {
        step_seconds.push_back(seconds_of(
          [&]()
          {
            if (schedule.is_static)
              moving.solve_equilibrium(schedule.time_of(frame));
            else
              cuts += moving.step(schedule.step).cuts;
          }));
        upsampling_seconds.push_back(seconds_of(upsample));
      }
      check_reach(moving.cloth().positions(), draped.coarse.positions, schedule.time_of(frame));
      if (frame == 0)
        upsample();
    }
    catch (const meshes::NotConverged &failure)
    {
      run.failure = failure.what();
      progress.note(name + ": " + run.failure);
      break;
    }
    run.frames.push_back(moving.cloth().positions());
    output.write_motion(draped.cell.name, variant, frame,
                        {run.frames.back().row(draped.centre_vertex),
                         moving.cloth().kinetic_energy(), moving.cloth().stored_energy(),
                         largest_stretch(draped.coarse, run.frames.back()), median(step_seconds),
                         median(upsampling_seconds)});
    // Of the variants one picture is enough: the report shows their curves.
    if (run.is_method() || frame == schedule.n_frames)
    {
      output.write_frame(name, "coarse", frame, run.frames.back().cast<float>(),
                         draped.coarse.triangles, {}, &coarse_list);
      output.write_frame(name, "fine", frame, fine, draped.fine_triangles(), draped.fine_data(),
                         &fine_list);
    }
    if (frame > 0)
      progress.done();
  }
  run.seconds_per_step       = median(step_seconds);
  run.seconds_per_upsampling = median(upsampling_seconds);
  run.description            = {{"variant", variant},
                                {"folder", name},
                                {"frames", run.frames.size()},
                                {"steps", step_seconds.size()},
                                {"cut_steps", cuts},
                                {"seconds_per_coarse_step", json_number(run.seconds_per_step)},
                                {"seconds_per_upsampling", json_number(run.seconds_per_upsampling)},
                                {"bytes", moving.cloth().bytes()},
                                {"threads", 1}};
  return run;
}

void measure_term_costs(const DrapedCell &draped, DrapeOutput &output, Progress &progress)
{
  for (const std::string &term : terms_that_can_be_forced())
  {
    if (output.has_term(draped.cell.name, term))
      continue;
    progress.begin(draped.cell.name + ": what `" + term + "` costs");
    TermRow row;
    row.is_present                   = draped.scene.has(term);
    std::tie(row.seconds, row.bytes) = cost(draped, {});
    if (!row.is_present)
      std::tie(row.forced_seconds, row.forced_bytes) = cost(draped, {term});
    output.write_term(draped.cell.name, term, row);
  }
}
} // namespace homespun::verification
