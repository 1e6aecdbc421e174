// SPDX-License-Identifier: MIT
#include "verification/drape/coarse_run.h"

#include "meshes/plain/errors.h"
#include "shell/terms/short_waves.h"
#include "verification/record/json_files.h"
#include "verification/record/number_text.h"
#include "verification/record/step_times.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>

namespace homespun::verification
{
namespace
{
/// A cloth ten thousand times its size away from where it began has blown up: pictures and curves
/// of it would show nothing else.
void check_reach(const shell::Vectors &positions, const shell::Vectors &start, const double time)
{
  constexpr double reach = 1e4;
  const double size      = (start.colwise().maxCoeff() - start.colwise().minCoeff()).maxCoeff();
  Eigen::Index vertex    = 0;
  const double moved     = (positions - start).rowwise().norm().maxCoeff(&vertex);
  if (moved > reach * size)
    throw meshes::NotConverged("the motion blows up: at " + short_text(time) + " s vertex " +
                                 std::to_string(vertex) + " is " + short_text(moved) +
                                 " m from where it began, the cloth being " + short_text(size) +
                                 " m large; try a smaller time step",
                               {});
}

/// A scene with terms forced upon it, whose steps are timed.
class TimedCloth
{
public:
  TimedCloth(const DrapedCell &draped, const std::set<std::string> &forced)
      : step_length(draped.scene.time_step)
      , moving(draped.scene, draped.coarse, draped.effective, draped.coarse_motion(), forced)
  {
  }

  /// A cloth that does not converge has no times from then on.
  void step()
  {
    if (failed)
      return;
    try
    {
      seconds.push_back(seconds_of([&]() { moving.step(step_length); }));
    }
    catch (const meshes::NotConverged &)
    {
      failed = true;
    }
  }

  /// Not a number where the cloth did not converge [s].
  double median_of_steps() const
  {
    return failed ? std::numeric_limits<double>::quiet_NaN() : median(seconds);
  }

  double spread_of_steps() const
  {
    return failed ? std::numeric_limits<double>::quiet_NaN() : half_of_interquartile_range(seconds);
  }

  std::size_t bytes() const
  {
    return moving.cloth().bytes();
  }

private:
  const double step_length; ///< [s]
  SceneCloth moving;
  std::vector<double> seconds;
  bool failed = false;
};

/// How many steps there were and how long they took, for drape.json.
/// @param n_factorizations of all of them; zero: not counted
nlohmann::ordered_json times_of_steps(const std::vector<double> &seconds,
                                      const int n_factorizations)
{
  const StepTimes times = step_times(seconds);
  const double per_step =
    n_factorizations > 0 ? n_factorizations / static_cast<double>(seconds.size()) : std::nan("");
  return {{"steps", seconds.size()},
          {"seconds_per_coarse_step", json_number(times.median)},
          {"seconds_per_coarse_step_mean", json_number(times.mean)},
          {"seconds_per_coarse_step_95", json_number(times.percentile_95)},
          {"factorizations_per_step", json_number(per_step)}};
}

/// What the steps of a run took [s], and how often they were cut and factored.
struct StepCosts
{
  std::vector<double> steps, upsampling;
  int cuts = 0, n_factorizations = 0;
};

/// Moves a cloth on to a frame, up-sampled at every step.
template <typename Upsample>
void move_to(const int frame, const DrapeSchedule &schedule, SceneCloth &moving,
             const Upsample &upsample, StepCosts &costs)
{
  for (int k = 0; k < schedule.steps_to(frame); ++k)
  {
    costs.steps.push_back(seconds_of(
      [&]()
      {
        if (schedule.is_static)
          moving.solve_equilibrium(schedule.time_of(frame));
        else
        {
          const shell::StepReport report = moving.step(schedule.step);
          costs.cuts += report.cuts;
          costs.n_factorizations += report.newton_iterations;
        }
      }));
    costs.upsampling.push_back(seconds_of(upsample));
  }
}
} // namespace

void RunOfWaves::add(const int frame_number, const double sides_of_frame, const double side)
{
  if (!std::isfinite(sides_of_frame))
    return;
  ++n;
  if (sides_of_frame < sides)
  {
    sides  = sides_of_frame;
    metres = sides * side;
    frame  = frame_number;
  }
}

std::string sentence_of(const RunOfWaves &waves, const std::size_t n_frames)
{
  if (waves.n == 0)
    return "";
  char line[240];
  std::snprintf(
    line, sizeof(line),
    "the coarse cloth has waves shorter than %.2g of its sides in %d of %zu frames, the "
    "shortest of some %.2g sides (%.2g cm) in frame %d: too short for the mesh, which "
    "may have made them; a finer one tells",
    shell::ShortWaves::longest, waves.n, n_frames, waves.sides, 100. * waves.metres, waves.frame);
  return line;
}

bool belongs(const CoarseRun &run, const DrapedCell &draped, const std::string &method)
{
  return run.cloth.is_of_method ? run.cloth.variant == method
                                : !has_own_cloth(draped.used(Method(method)));
}

std::vector<CoarseCloth> cloths_of(const DrapeOptions &options, const Law main,
                                   const std::function<Method(const Method &)> &used)
{
  std::vector<CoarseCloth> cloths;
  const Method plain("localized");
  for (const std::string &name : options.variants)
    cloths.push_back({name, membrane_of(name), plain, false});
  if (cloths.empty())
    cloths.push_back({name_of(main), main, plain, false});
  for (const std::string &name : options.methods)
    if (has_own_cloth(used(Method(name))))
      cloths.push_back({name, main, Method(name), true});
  return cloths;
}

CoarseRun run_coarse(const DrapedCell &draped, const CoarseCloth &cloth,
                     const DrapeSchedule &schedule, DrapeOutput &output, Progress &progress)
{
  const std::string &variant = cloth.variant, name = draped.cell.name + "-" + variant;
  CoarseRun run               = {cloth, variant == name_of(draped.law)};
  const MovingCloth of_rows   = {draped.cell.name, MovingCloth::coarse, variant};
  const std::string folder    = output.folder + "/" + name;
  const Upsampler3f upsampler = draped.upsampler<float>(cloth.method);
  std::filesystem::create_directories(folder);
  meshes::FrameCollection coarse_list(folder + "/coarse.pvd"), fine_list(folder + "/fine.pvd");
  StepCosts costs;
  Upsampler3f::Fine fine;
  const HeldMotion held  = draped.coarse_motion();
  ClothMaterial material = draped.effective_of(cloth.method);
  material.law           = cloth.law;
  SceneCloth moving(draped.scene, draped.coarse, material, held);
  const shell::ShortWaves finder(draped.coarse);
  const auto upsample = [&]() { upsampler.upsample(moving.cloth().positions(), fine); };
  for (int frame = 0; frame <= schedule.n_frames; ++frame)
  {
    progress.begin(draped.cell.name + ", " + variant + " cloth, frame " + std::to_string(frame));
    try
    {
      move_to(frame, schedule, moving, upsample, costs);
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
    run.waves.add(frame, finder.shortest(run.frames.back()), finder.side());
    if (frame > 0)
      output.write_held_forces(
        of_rows, frame,
        held_forces(held, {draped.coarse, moving.cloth().masses(), moving.cloth().gradient(),
                           schedule.time_of(frame), schedule.step_of_forces()}));
    MotionRow row = output.motion_row(of_rows, frame, run.frames.back().row(draped.centre_vertex));
    row.kinetic   = moving.cloth().kinetic_energy();
    row.elastic   = moving.elastic_energy();
    row.gravity   = gravity_energy(draped.scene, moving.cloth().masses(), run.frames.back());
    row.stretch   = largest_stretch(draped.coarse, run.frames.back());
    row.step_seconds       = median(costs.steps);
    row.upsampling_seconds = median(costs.upsampling);
    output.write(row);
    // Of the variants one picture is enough: the report shows their curves.
    if (run.is_main || cloth.is_of_method || frame == schedule.n_frames)
    {
      output.write_frame({name, "coarse", frame}, run.frames.back(), draped.coarse.triangles, {},
                         &coarse_list);
      output.write_frame({name, "fine", frame}, fine.cast<double>(), draped.fine_triangles(),
                         draped.fine_data(), &fine_list);
    }
    if (frame > 0)
      progress.done();
  }
  run.seconds_per_step       = median(costs.steps);
  run.seconds_per_upsampling = median(costs.upsampling);
  run.description            = {{"variant", variant},
                                {"folder", name},
                                {"frames", run.frames.size()},
                                {"cut_steps", costs.cuts},
                                {"frames_with_short_waves", run.waves.n},
                                {"shortest_wave_sides", json_number(run.waves.sides)},
                                {"bytes", moving.cloth().bytes()},
                                {"threads", 1}};
  run.description.update(times_of_steps(costs.steps, costs.n_factorizations));
  run.description["seconds_per_upsampling"] = json_number(run.seconds_per_upsampling);
  return run;
}

void measure_term_costs(const DrapedCell &draped, DrapeOutput &output, Progress &progress)
{
  constexpr int n_steps = 60;
  for (const std::string &term : terms_with_a_cost(draped.scene))
  {
    TermRow row = output.term_row(draped.cell.name, term);
    if (output.has(row))
      continue;
    progress.begin(draped.cell.name + ": what `" + term + "` costs");
    row.is_present = draped.scene.has(term);
    // Turn about, so that what else the machine does falls on both alike.
    TimedCloth as_it_is(draped, {});
    std::optional<TimedCloth> with_term;
    if (!row.is_present)
      try
      {
        with_term.emplace(draped, std::set<std::string>{term});
      }
      catch (const meshes::BadInput &fault)
      {
        progress.note(draped.cell.name + ": `" + term + "` has no cost here: " + fault.what());
      }
    for (int k = 0; k < n_steps; ++k)
    {
      as_it_is.step();
      if (with_term)
        with_term->step();
    }
    row.seconds = as_it_is.median_of_steps();
    row.spread  = as_it_is.spread_of_steps();
    row.bytes   = as_it_is.bytes();
    if (with_term)
    {
      row.forced_seconds = with_term->median_of_steps();
      row.forced_spread  = with_term->spread_of_steps();
      row.forced_bytes   = with_term->bytes();
    }
    output.write(row);
  }
}
} // namespace homespun::verification
