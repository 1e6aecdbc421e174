// SPDX-License-Identifier: MIT
#include "verification/drape/drape_study.h"

#include "homogenization/lint/cell_reading.h"
#include "meshes/files/obj_file.h"
#include "meshes/plain/errors.h"
#include "shell/terms/membrane_term.h"
#include "verification/cell/cell_study.h"
#include "verification/cell/study_inputs.h"
#include "verification/drape/drape_errors.h"
#include "verification/drape/drape_inputs.h"
#include "verification/drape/drape_verdicts.h"
#include "verification/drape/fine_run.h"
#include "verification/drape/obstacle_surface.h"
#include "verification/laws/default_law.h"
#include "verification/record/json_files.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"
#include "verification/record/provenance.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

namespace homespun::verification
{
using homogenization::UnitCell;
using meshes::SpacePoints;

namespace
{
class DrapeStudy
{
public:
  DrapeStudy(const DrapeOptions &options, const MPI_Comm communicator)
      : options(options)
      , communicator(communicator)
      , n_ranks(n_ranks_of(communicator))
      , is_root(verification::is_root(communicator))
      , scene(scene_of(options))
      , schedule(scene)
      , progress(is_root && !options.quiet,
                 static_cast<int>(scene.cell_files.size()) * schedule.n_frames *
                   static_cast<int>(cloths(options).size() + options.references.size()))
  {
  }

  std::vector<Verdict> run()
  {
    check_references(options, scene);
    std::vector<UnitCell> cells;
    for (const std::string &file : scene.cell_files)
      cells.push_back(homogenization::read_unit_cell(file, communicator));
    check_names(cells);
    check_cloth(options, scene, cells);
    const nlohmann::ordered_json inputs = drape_inputs(options, scene, schedule, cells);
    name_of_run                         = fingerprint(json_text(inputs));
    on_root(
      communicator,
      [&]()
      {
        folder = open_run_folder(options.output, {"drape", inputs}, options.earlier, options.quiet);
        output = std::make_unique<DrapeOutput>(options.output, scene.name, schedule.interval,
                                               options.frames, options.costs);
      });
    if (schedule.duration() < scene.duration * (1. - 1e-6))
      note(scene.name + ": runs for " + short_text(schedule.duration()) + " s of the " +
           short_text(scene.duration) + " s asked for, whole frames of " +
           short_text(schedule.interval) + " s");
    for (const std::string &warning : scene_warnings(scene, cells))
      note(warning);
    for (const UnitCell &cell : cells)
      study_cell(cell);
    return conclude();
  }

private:
  /// For the terminal and for drape.json.
  void note(const std::string &text)
  {
    progress.note(text);
    notes.push_back(text);
  }

  std::string state_file(const std::string &name) const
  {
    return options.output + "/" + name + "/checkpoint.h5";
  }

  void study_cell(const UnitCell &cell)
  {
    progress.begin(cell.name + ": homogenization", true);
    AssessedCell assessed =
      assess_for_study(cell, communicator, verdicts, laws_of_methods(options));
    if (scene.has("bending") && !scene.bending)
      add_bending_for_study(cell, communicator, assessed, verdicts);
    if (const std::string loss = note_on_corotational_cloth(assessed.result.stiffness);
        !loss.empty())
      note(cell.name + ": " + loss);
    const DrapedCell draped(scene, cell, homogenized_cell(cell, assessed, provenance_line()),
                            edges_for(options, cell));
    if (draped.edges)
      note(cell.name + ": " + draped.moving_edges().sentence());
    nlohmann::ordered_json description = description_of(draped);

    std::vector<CoarseRun> runs;
    std::unique_ptr<DrapeComparison> comparison; // on the first rank
    on_root(communicator,
            [&]()
            {
              write_obstacles(draped);
              for (const Verdict &check : checks_of_scene(draped))
                verdicts.push_back(check);
              for (const std::string &variant : cloths(options))
              {
                runs.push_back(run_coarse(draped, variant, schedule, *output, progress));
                judge(draped, runs.back());
                description["runs"].push_back(runs.back().description);
              }
              if (options.costs)
                measure_term_costs(draped, *output, progress);
              if (!options.references.empty())
                comparison = std::make_unique<DrapeComparison>(draped, options.methods, runs);
            });
    for (const std::string &reference : options.references)
      description["references"].push_back(run_reference(draped, reference, runs, comparison.get()));
    cell_descriptions.push_back(description);
  }

  nlohmann::ordered_json description_of(const DrapedCell &draped)
  {
    sizes                         = {{"coarse_triangles", draped.coarse.n_triangles()},
                                     {"fine_triangles", draped.fine.n_triangles()},
                                     {"fine_vertices", draped.n_fine()}};
    nlohmann::ordered_json phases = nlohmann::ordered_json::array(), stiffness = phases;
    for (const int phase : draped.cell.phase_of_group())
    {
      phases.push_back(draped.cell.phases[static_cast<std::size_t>(phase)].name);
      stiffness.push_back(draped.phases.stiffness[static_cast<std::size_t>(phase)].trace());
    }
    nlohmann::ordered_json description = {
      {"cell", draped.cell.name},
      {"cell_side_m", draped.side},
      {"phases", phases},
      {"phase_stiffness", stiffness}, // trace [N/m]: pictures are darker with it
      {"C", rows_of(draped.homogenized.stiffness)},
      {"areal_density", draped.homogenized.areal_density},
      {"runs", nlohmann::ordered_json::array()},
      {"references", nlohmann::ordered_json::array()}};
    if (scene.has("bending"))
    {
      description["D"] =
        rows_of((scene.bending ? *scene.bending : draped.effective.bending.front()).matrix());
      description["D_from"] = scene.bending ? "scene" : "cell";
    }
    return description;
  }

  /// obstacles.vtu, for pictures.
  void write_obstacles(const DrapedCell &draped) const
  {
    const Eigen::RowVector3d low  = draped.coarse.positions.colwise().minCoeff(),
                             high = draped.coarse.positions.colwise().maxCoeff();
    const meshes::Surface bodies =
      obstacle_surface(scene, 0.5 * (low + high), (high - low).maxCoeff());
    if (bodies.triangles.rows() > 0)
      meshes::write_vtu(options.output + "/obstacles.vtu", bodies.positions.cast<float>(),
                        bodies.triangles);
  }

  void judge(const DrapedCell &draped, const CoarseRun &run)
  {
    const std::string title = draped.cell.name + ", " + run.variant;
    verdicts.push_back(verdict_of_cloth(title, run.is_method() || run.is_of_method,
                                        static_cast<int>(run.frames.size()),
                                        schedule.n_frames + 1));
    if (!run.failure.empty())
      notes.push_back(title + ": " + run.failure);
  }

  /// A full-resolution cloth over all frames, and the errors of every coarse run against it.
  /// @param comparison of the coarse runs, on the first rank
  /// @return what drape.json says of it
  nlohmann::ordered_json run_reference(const DrapedCell &draped, const std::string &reference,
                                       const std::vector<CoarseRun> &runs,
                                       const DrapeComparison *comparison)
  {
    const std::string name  = draped.cell.name + "-" + reference;
    const std::string place = options.output + "/" + name;
    const std::string title = draped.cell.name + ", " + reference;
    progress.begin(title + ": setting up", true);
    on_root(communicator, [&]() { std::filesystem::create_directories(place); });
    const std::unique_ptr<FineRun> fine =
      is_dealii(reference) ? dealii_run(draped, law_of(reference), {}, communicator)
                           : shell_run(draped, communicator);
    int first = 0;
    std::vector<double> seconds;
    if (const auto state = state_to_resume(name, reference, fine->n_vertices(), comparison))
    {
      fine->resume(*state);
      first   = state->frame + 1;
      seconds = state->step_seconds;
    }
    DrapeErrorBar bar;
    if (is_dealii(reference) && options.n_cells_of_error_bar > 0 && first <= schedule.n_frames)
    {
      bar = drape_error_bar(
        draped, law_of(reference), std::min(options.n_cells_of_error_bar, scene.n1), schedule,
        communicator,
        [&](const int frame)
        { progress.begin(title + ": error bar, frame " + std::to_string(frame), true); });
    }
    std::unique_ptr<meshes::FrameCollection> list;
    on_root(communicator,
            [&]()
            {
              list = std::make_unique<meshes::FrameCollection>(place + "/fine.pvd");
              output->list_earlier_frames(name, first, *list);
            });
    const Eigen::VectorXd masses = shell::lumped_masses(draped.fine, draped.phases.areal_density);
    const HeldMotion held        = draped.fine_motion();
    int n_frames                 = first; ///< reached
    for (int frame = first; frame <= schedule.n_frames; ++frame)
    {
      progress.begin(title + " reference, frame " + std::to_string(frame), true);
      if (const std::string why = advance(*fine, frame, seconds); !why.empty())
      {
        note(title + ": the reference stops at frame " + std::to_string(frame) + ": " + why);
        break;
      }
      const SpacePoints positions  = draped.at_fine_vertices(fine->positions());
      const SpacePoints velocities = fine->velocities();
      const double kinetic = fine->kinetic_energy(), elastic = fine->elastic_energy();
      const SpacePoints gradient = fine->gradient();
      on_root(communicator,
              [&]()
              {
                MotionRow motion    = output->motion_row(draped.cell.name, reference, frame,
                                                         positions.row(draped.fine_centre_vertex));
                motion.kinetic      = kinetic;
                motion.elastic      = elastic;
                motion.gravity      = gravity_energy(scene, masses, fine->positions());
                motion.step_seconds = median(seconds);
                if (frame > 0)
                  output->write_held_forces(
                    draped.cell.name, reference, frame,
                    held_forces(held, {draped.fine, masses, gradient, schedule.time_of(frame),
                                       schedule.step_of_forces()}));
                // The error belongs to method and reference, and stands with the frame that comes
                // once for both.
                meshes::SurfaceData data = draped.fine_data();
                for (meshes::VertexData &error :
                     comparison->compare(reference, frame, positions, bar, *output))
                  data.on_vertices.push_back(std::move(error));
                output->write(motion);
                output->write_frame(name, "fine", frame, positions, draped.fine_triangles(), data,
                                    list.get());
                meshes::write_state(
                  {fine->positions(), velocities, fine->time(), frame, name_of_run, seconds},
                  state_file(name));
              });
      n_frames = frame + 1;
      if (frame > 0)
        progress.done();
    }
    verdicts.push_back(verdict_of_reference(title, n_frames, schedule.n_frames + 1));
    if (is_dealii(reference) && options.n_cells_of_error_bar > 0)
      on_root(communicator,
              [&]()
              {
                for (const Verdict &verdict : verdicts_of_accuracy(
                       output->error_rows(), draped.cell.name, reference, draped.side))
                  verdicts.push_back(verdict);
              });
    // A time depends on the machine: reported, never judged.
    double ratio = std::numeric_limits<double>::quiet_NaN();
    for (const CoarseRun &run : runs)
      if (run.is_method())
        ratio = median(seconds) / (run.seconds_per_step + run.seconds_per_upsampling);
    if (std::isfinite(ratio))
      progress.note(title + ": one step takes as long as " + short_text(ratio) +
                    " coarse steps with up-sampling (1 thread)");
    return {{"reference", reference},
            {"folder", name},
            {"seconds_per_step", json_number(median(seconds))},
            {"coarse_steps_per_step", json_number(ratio)},
            {"ranks", is_dealii(reference) ? n_ranks : 1u},
            {"threads", 1},
            {"dofs", fine->n_dofs()}};
  }

  /// The state from which a reference goes on; nothing where it begins anew, as it does where a
  /// table has lost rows of the frames before.
  /// @param comparison on the first rank
  std::optional<meshes::ClothState> state_to_resume(const std::string &name,
                                                    const std::string &reference,
                                                    const int n_vertices,
                                                    const DrapeComparison *comparison)
  {
    // Every rank reads the same file.
    std::optional<meshes::ClothState> state =
      meshes::read_state(state_file(name), n_vertices, name_of_run);
    int first_without_rows = 0;
    on_root(communicator,
            [&]()
            {
              while (state && first_without_rows <= state->frame &&
                     comparison->has_rows(reference, first_without_rows, *output))
                ++first_without_rows;
            });
    MPI_Bcast(&first_without_rows, 1, MPI_INT, 0, communicator);
    if (!state || first_without_rows > state->frame)
      return state;
    progress.note(
      name + ": rows of frame " + std::to_string(first_without_rows) +
      " are missing in drape.csv, motion.csv or held-forces.csv: the reference begins anew");
    return std::nullopt;
  }

  /// To the next frame. @return the reason where it was not reached
  std::string advance(FineRun &fine, const int frame, std::vector<double> &seconds) const
  {
    for (int k = 0; k < schedule.steps_to(frame); ++k)
    {
      const FineStep step =
        fine.advance(schedule.is_static, schedule.step, schedule.time_of(frame));
      if (!step.why.empty())
        return step.why;
      seconds.push_back(step.seconds);
    }
    return "";
  }

  std::vector<Verdict> conclude()
  {
    on_root(communicator,
            [&]()
            {
              nlohmann::ordered_json terms = nlohmann::ordered_json::array();
              for (const auto &[term, what] : all_terms())
                terms.push_back({{"name", term},
                                 {"present", scene.has(term)},
                                 {scene.has(term) ? "parameters" : "why",
                                  scene.has(term) ? what : "the scene does not list it"}});
              for (const std::string &line : output->worst_errors())
                progress.note(line);
              nlohmann::ordered_json study = {
                {"scene", scene.name},
                {"story", scene.story},
                {"command", options.command},
                {"provenance", provenance(n_ranks)},
                {"time_step_s", scene.time_step},
                {"duration_s", schedule.duration()},
                {"integrator", scene.echo.count("Integrator") ? scene.echo.at("Integrator") : ""},
                {"terms", terms},
                {"left_out", what_was_left_out(options, scene)},
                {"notes", notes},
                {"cells", cell_descriptions},
                {"parameters", scene.echo}};
              study.update(sizes);
              write_json(options.output + "/verdicts.json", to_json(verdicts, options.command));
              write_json(options.output + "/drape.json", study);
              folder->finish();
            });
    share_failure(verdicts, communicator);
    return verdicts;
  }

  const DrapeOptions options;
  const MPI_Comm communicator;
  const unsigned int n_ranks;
  const bool is_root;
  const Scene scene;
  const DrapeSchedule schedule;
  std::string name_of_run; ///< hash of what it is made of
  Progress progress;
  std::unique_ptr<RunFolder> folder;   ///< on the first rank
  std::unique_ptr<DrapeOutput> output; ///< on the first rank
  std::vector<std::string> notes;
  nlohmann::ordered_json cell_descriptions = nlohmann::ordered_json::array(), sizes;
  std::vector<Verdict> verdicts;
};
} // namespace

std::vector<Verdict> run_drape_study(const DrapeOptions &options, const MPI_Comm communicator)
{
  return DrapeStudy(options, communicator).run();
}
} // namespace homespun::verification
