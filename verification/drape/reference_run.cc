// SPDX-License-Identifier: MIT
#include "verification/drape/reference_run.h"

#include "meshes/files/state_file.h"
#include "shell/terms/membrane_term.h"
#include "verification/drape/drape_error_bar.h"
#include "verification/drape/drape_inputs.h"
#include "verification/drape/drape_verdicts.h"
#include "verification/drape/fine_run.h"
#include "verification/drape/kept_frames.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

namespace homespun::verification
{
using meshes::SpacePoints;

namespace
{
class ReferenceRun
{
public:
  ReferenceRun(DrapeRun &run, const DrapedCell &draped, const std::string &reference,
               const CoarseRuns &coarse)
      : run(run)
      , draped(draped)
      , reference(reference)
      , coarse(coarse)
      , name(draped.cell.name + "-reference-" + reference)
      , place(run.options.output + "/" + name)
      , title(draped.cell.name + ", " + reference)
      , cloth{draped.cell.name, MovingCloth::reference, reference}
      , masses(shell::lumped_masses(draped.fine, draped.phases.areal_density))
      , held(draped.fine_motion())
  {
  }

  nlohmann::ordered_json to_the_end()
  {
    run.progress.milestone(title + ": setting up");
    on_root(run.communicator, [&]() { std::filesystem::create_directories(place); });
    fine = is_dealii(reference) ? dealii_run(draped, law_of(reference), {}, run.communicator)
                                : shell_run(draped, run.communicator);
    const int first = take_up();
    make_error_bar(first);
    on_root(run.communicator,
            [&]()
            {
              list = std::make_unique<meshes::FrameCollection>(place + "/fine.pvd");
              run.output->list_earlier_frames(name, first, *list);
            });
    int n_frames = first; ///< reached
    for (int frame = first; frame <= run.schedule.n_frames; ++frame)
    {
      run.progress.milestone(title + " reference, frame " + std::to_string(frame));
      if (const std::string why = advance(frame); !why.empty())
      {
        run.note(title + ": the reference stops at frame " + std::to_string(frame) + ": " + why);
        break;
      }
      write(frame);
      n_frames = frame + 1;
      if (frame > 0)
        run.progress.done();
    }
    note_on_frames_not_kept(n_frames);
    judge(n_frames);
    return description();
  }

private:
  /// @return the frame to begin with
  int take_up()
  {
    const auto state = state_to_resume();
    if (!state)
      return 0;
    fine->resume(*state);
    seconds = state->step_seconds;
    return state->frame + 1;
  }

  /// The state from which the reference goes on; nothing where it begins anew, as it does where a
  /// table has lost rows of the frames before.
  std::optional<meshes::ClothState> state_to_resume()
  {
    // Every rank reads the same file.
    std::optional<meshes::ClothState> state =
      meshes::read_state(state_file(), fine->n_vertices(), run.name);
    int first_without_rows = 0;
    on_root(run.communicator,
            [&]()
            {
              while (state && first_without_rows <= state->frame &&
                     coarse.comparison->has_rows(reference, first_without_rows, *run.output))
                ++first_without_rows;
            });
    MPI_Bcast(&first_without_rows, 1, MPI_INT, 0, run.communicator);
    if (!state || first_without_rows > state->frame)
      return state;
    run.progress.note(name + ": rows of frame " + std::to_string(first_without_rows) +
                      " are missing in drape.csv or motion.csv: the reference begins anew");
    return std::nullopt;
  }

  void make_error_bar(const int first)
  {
    if (!has_error_bar() || first > run.schedule.n_frames)
      return;
    bar = drape_error_bar(
      draped, law_of(reference), std::min(run.options.n_cells_of_error_bar, draped.scene.n1),
      run.schedule, run.communicator,
      [&](const int frame)
      { run.progress.milestone(title + ": error bar, frame " + std::to_string(frame)); });
    on_root(run.communicator,
            [&]()
            {
              for (const CoarseRun &cloth : coarse.all)
                if (run.options.keep && cloth.is_main)
                  bar.coarse_step = changes_by_halved_step(draped, cloth.frames, run.schedule);
            });
  }

  /// To the next frame. @return the reason where it was not reached
  std::string advance(const int frame)
  {
    for (int k = 0; k < run.schedule.steps_to(frame); ++k)
    {
      const FineStep step =
        fine->advance(run.schedule.is_static, run.schedule.step, run.schedule.time_of(frame));
      if (!step.why.empty())
        return step.why;
      seconds.push_back(step.seconds);
    }
    return "";
  }

  /// A frame with its rows, and the state from which the next one goes on.
  void write(const int frame)
  {
    const SpacePoints positions  = draped.at_fine_vertices(fine->positions());
    const SpacePoints velocities = fine->velocities();
    const double kinetic = fine->kinetic_energy(), elastic = fine->elastic_energy();
    const SpacePoints gradient = fine->gradient();
    on_root(run.communicator,
            [&]()
            {
              DrapeOutput &output = *run.output;
              MotionRow motion =
                output.motion_row(cloth, frame, positions.row(draped.fine_centre_vertex));
              motion.kinetic      = kinetic;
              motion.elastic      = elastic;
              motion.gravity      = gravity_energy(draped.scene, masses, fine->positions());
              motion.step_seconds = median(seconds);
              if (frame > 0)
                output.write_held_forces(
                  cloth, frame,
                  held_forces(held, {draped.fine, masses, gradient, run.schedule.time_of(frame),
                                     run.schedule.step_of_forces()}));
              // The error belongs to method and reference, and stands with the frame that comes
              // once for both.
              meshes::SurfaceData data = draped.fine_data();
              for (meshes::VertexData &error :
                   coarse.comparison->compare(reference, frame, positions, bar, output))
                data.on_vertices.push_back(std::move(error));
              output.write(motion);
              keep(frame, positions);
              output.write_frame({name, "fine", frame}, positions, draped.fine_triangles(), data,
                                 list.get());
              meshes::write_state(
                {fine->positions(), velocities, fine->time(), frame, run.name, seconds},
                state_file());
            });
  }

  /// For methods of other people, which start from the coarse cloth that is the method's.
  void keep(const int frame, const SpacePoints &positions) const
  {
    const auto at = static_cast<std::size_t>(frame);
    if (run.options.keep)
      for (const CoarseRun &cloth : coarse.all)
        if (cloth.is_main && cloth.frames.size() > at)
          keep_frame(run.options.output, draped,
                     {reference, frame, {cloth.frames[at], positions}, bar.of_coarse_step_at(at)});
  }

  void note_on_frames_not_kept(const int n_frames)
  {
    for (const CoarseRun &cloth : coarse.all) // of the first rank
      if (const auto n_kept = static_cast<int>(cloth.frames.size());
          run.options.keep && cloth.is_main && n_kept < n_frames)
        run.note(title + ": positions are not kept from frame " + std::to_string(n_kept) +
                 " to frame " + std::to_string(n_frames - 1) +
                 ", which the coarse cloth did not reach: " + cloth.failure);
  }

  void judge(const int n_frames)
  {
    run.verdicts.push_back(
      verdict_of_reference(draped.cell.name, reference, n_frames, run.schedule.n_frames + 1));
    if (has_error_bar())
      on_root(run.communicator,
              [&]()
              {
                for (const Verdict &verdict : verdicts_of_accuracy(
                       run.output->error_rows(), {draped.cell.name, name_of(draped.law), reference},
                       draped.side))
                  run.verdicts.push_back(verdict);
              });
  }

  nlohmann::ordered_json description()
  {
    // A time depends on the machine: reported, never judged.
    double ratio = std::numeric_limits<double>::quiet_NaN();
    for (const CoarseRun &cloth : coarse.all)
      if (cloth.is_main)
        ratio = median(seconds) / (cloth.seconds_per_step + cloth.seconds_per_upsampling);
    if (std::isfinite(ratio))
      run.progress.note(title + ": one step takes as long as " + short_text(ratio) +
                        " coarse steps with up-sampling (1 thread)");
    return {{"reference", reference},
            {"folder", name},
            {"seconds_per_step", json_number(median(seconds))},
            {"coarse_steps_per_step", json_number(ratio)},
            {"ranks", is_dealii(reference) ? n_ranks_of(run.communicator) : 1u},
            {"threads", 1},
            {"dofs", fine->n_dofs()}};
  }

  bool has_error_bar() const
  {
    return is_dealii(reference) && run.options.n_cells_of_error_bar > 0;
  }

  std::string state_file() const
  {
    return place + "/checkpoint.h5";
  }

  DrapeRun &run;
  const DrapedCell &draped;
  const std::string reference;
  const CoarseRuns &coarse;
  const std::string name, place, title;
  const MovingCloth cloth;
  const Eigen::VectorXd masses;
  const HeldMotion held;
  std::unique_ptr<FineRun> fine;
  std::vector<double> seconds; ///< of each step
  DrapeErrorBar bar;
  std::unique_ptr<meshes::FrameCollection> list; ///< on the first rank
};
} // namespace

nlohmann::ordered_json run_reference(DrapeRun &run, const DrapedCell &draped,
                                     const std::string &reference, const CoarseRuns &coarse)
{
  return ReferenceRun(run, draped, reference, coarse).to_the_end();
}
} // namespace homespun::verification
