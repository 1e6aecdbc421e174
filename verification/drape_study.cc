// SPDX-License-Identifier: MIT
#include "verification/drape_study.h"

#include "meshes/errors.h"
#include "meshes/obj_file.h"
#include "verification/cell_output.h"
#include "verification/drape_errors.h"
#include "verification/obstacle_surface.h"
#include "verification/on_root.h"
#include "verification/progress.h"
#include "verification/provenance.h"
#include "verification/study_inputs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace homespun::verification
{
using homogenization::UnitCell;
using meshes::SpacePoints;

namespace
{
bool is_dealii(const std::string &reference)
{
  return reference != "shell";
}

class DrapeStudy
{
public:
  DrapeStudy(const DrapeOptions &options, const MPI_Comm communicator)
      : options(options)
      , communicator(communicator)
      , n_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator))
      , is_root(verification::is_root(communicator))
      , scene(scene_of(options))
      , schedule(scene)
      , progress(is_root && !options.quiet,
                 static_cast<int>(scene.cell_files.size()) * schedule.n_frames *
                   static_cast<int>(options.variants.size() + options.references.size()))
  {
  }

  std::vector<Verdict> run()
  {
    check();
    std::vector<UnitCell> cells;
    for (const std::string &file : scene.cell_files)
      cells.push_back(homogenization::read_unit_cell(file));
    check_names(cells);
    check_cloth(cells);
    on_root(communicator,
            [&]()
            {
              std::filesystem::create_directories(options.output);
              check_drape_inputs(cells);
              output = std::make_unique<DrapeOutput>(options.output, scene.name, schedule.interval,
                                                     options.frames, options.costs, options.resume);
            });
    for (const UnitCell &cell : cells)
      study_cell(cell);
    return conclude();
  }

private:
  static Scene scene_of(const DrapeOptions &options)
  {
    Scene scene = read_scene(options.scene_file);
    if (!options.cell_files.empty())
      scene.cell_files = options.cell_files;
    if (options.n_cells > 0)
      scene = scaled(scene, options.n_cells);
    if (options.time_step > 0.)
      scene.time_step = options.time_step;
    if (options.duration > 0.)
      scene.duration = options.duration;
    scene.frame_interval =
      std::min(scene.duration,
               scene.time_step * std::max(1., std::round(scene.frame_interval / scene.time_step)));
    return scene;
  }

  /// What a scene cannot be asked for.
  void check() const
  {
    std::vector<std::string> faults;
    for (const std::string &reference : options.references)
    {
      if (!is_dealii(reference))
        continue;
      if (!scene.is_sheet())
        faults.push_back("--references " + reference + ": scene `" + scene.name +
                         "` is a garment; expected a flat sheet, or the reference `shell`");
      for (const char *term : {"bending", "wind", "obstacles"})
        if (scene.has(term))
          faults.push_back("--references " + reference + ": scene `" + scene.name +
                           "` has the term `" + term +
                           "`, which this reference lacks; expected the reference `shell`");
      if (scene.has("damping") && scene.viscosity > 0.)
        faults.push_back("--references " + reference + ": scene `" + scene.name +
                         "` has a `Viscosity`, which this reference lacks; expected 0, or the "
                         "reference `shell`");
      for (const HeldPlace &held : scene.held)
        if (held.place == "vertices" || held.place == "waist")
          faults.push_back("--references " + reference + ": scene `" + scene.name +
                           "` holds single vertices; expected edges or corners by name");
    }
    if (scene.integration == TimeIntegration::equilibria)
      for (const char *term : {"wind", "obstacles"})
        if (scene.has(term))
          faults.push_back(scene.file + ": key `Integrator` = static with the term `" + term +
                           "`; expected `implicit` or `linearly implicit`");
    if (!faults.empty())
      throw meshes::BadInput(faults);
  }

  /// Refuses a cloth that makes no sense before any file is written.
  void check_cloth(const std::vector<UnitCell> &cells) const
  {
    int n_coarse = (scene.n1 + 1) * (scene.n2 + 1);
    for (const UnitCell &cell : cells)
      if (scene.is_sheet())
        meshes::tile(cell.mesh, cell.lattice, 1, 1);
    if (!scene.is_sheet())
      n_coarse = meshes::read_cloth(scene.mesh_file, scene.vt_unit).n_vertices();
    std::vector<std::string> faults;
    for (const HeldPlace &held : scene.held)
      for (const int v : held.vertices)
        if (v >= n_coarse)
          faults.push_back(scene.file + ": held vertex " + std::to_string(v) +
                           " does not exist; expected 0 ... " + std::to_string(n_coarse - 1));
    if (!faults.empty())
      throw meshes::BadInput(faults);
  }

  /// Rows of different inputs never stand in one table.
  void check_drape_inputs(const std::vector<UnitCell> &cells) const
  {
    nlohmann::ordered_json inputs = {{"scene", scene.echo},
                                     {"time_step", scene.time_step},
                                     {"duration", scene.duration},
                                     {"frame_interval", scene.frame_interval},
                                     {"sheet_cells", {scene.n1, scene.n2}}};
    for (const UnitCell &cell : cells)
      inputs["cells"][cell.name] = fingerprint(cell);
    check_inputs_file(options.output, inputs, options.resume, "drape.csv");
  }

  void study_cell(const UnitCell &cell)
  {
    progress.begin(cell.name + ": homogenization", true);
    homogenization::HomogenizationOptions p1;
    p1.order                    = 1;
    const AssessedCell assessed = assess(cell, p1, 0, communicator);
    const DrapedCell draped(
      scene, cell, homogenization::homogenized_cell(cell, assessed.result, provenance_line()));
    nlohmann::ordered_json description = description_of(draped);

    std::vector<CoarseRun> runs;
    on_root(communicator,
            [&]()
            {
              write_obstacles(draped);
              for (const std::string &variant : options.variants)
              {
                runs.push_back(run_coarse(draped, variant, schedule, *output, progress));
                judge(draped, runs.back());
                description["runs"].push_back(runs.back().description);
              }
              if (options.costs)
                measure_term_costs(draped, *output, progress);
            });
    for (const std::string &reference : options.references)
      description["references"].push_back(run_reference(draped, reference, runs));
    cell_descriptions.push_back(description);
  }

  nlohmann::ordered_json description_of(const DrapedCell &draped)
  {
    sizes                         = {{"coarse_triangles", draped.coarse.n_triangles()},
                                     {"fine_triangles", draped.fine.n_triangles()},
                                     {"fine_vertices", draped.n_fine()}};
    const Eigen::Matrix3d C       = draped.homogenized.stiffness;
    nlohmann::ordered_json phases = nlohmann::ordered_json::array();
    for (const homogenization::Phase &phase : draped.cell.phases)
      phases.push_back(phase.name);
    return {
      {"cell", draped.cell.name},
      {"cell_side_m", draped.side},
      {"phases", phases},
      {"C",
       {{C(0, 0), C(0, 1), C(0, 2)}, {C(1, 0), C(1, 1), C(1, 2)}, {C(2, 0), C(2, 1), C(2, 2)}}},
      {"areal_density", draped.homogenized.areal_density},
      {"runs", nlohmann::ordered_json::array()},
      {"references", nlohmann::ordered_json::array()}};
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
    const int expected = schedule.n_frames + 1, found = static_cast<int>(run.frames.size());
    verdicts.push_back(
      {draped.cell.name + ", " + run.variant + ": the scene runs to its end (frames reached)",
       found == expected ? Outcome::pass
       : run.is_method() ? Outcome::fail
                         : Outcome::inconclusive,
       static_cast<double>(found), std::to_string(expected)});
  }

  /// A full-resolution cloth over all frames, and the errors of every coarse run against it.
  /// @return what drape.json says of it
  nlohmann::ordered_json run_reference(const DrapedCell &draped, const std::string &reference,
                                       const std::vector<CoarseRun> &runs)
  {
    const std::string name   = draped.cell.name + "-" + reference;
    const std::string folder = options.output + "/" + name;
    const std::string title  = draped.cell.name + ", " + reference;
    progress.begin(title + ": setting up", true);
    on_root(communicator, [&]() { std::filesystem::create_directories(folder); });
    const std::unique_ptr<FineRun> fine = is_dealii(reference)
                                            ? dealii_run(draped, law_of(reference), 1, communicator)
                                            : shell_run(draped, communicator);
    DrapeErrorBar bar;
    if (is_dealii(reference) && options.n_cells_of_error_bar > 0)
    {
      progress.begin(title + ": error bar", true);
      bar =
        drape_error_bar(draped, law_of(reference), std::min(options.n_cells_of_error_bar, scene.n1),
                        schedule, communicator);
    }
    int first                    = 0;
    const std::string checkpoint = folder + "/checkpoint.h5";
    if (options.resume)
      // Every rank reads the same file.
      if (const auto state = meshes::read_state(checkpoint, fine->n_vertices()))
      {
        fine->resume(*state);
        first = state->frame + 1;
      }
    std::unique_ptr<meshes::FrameCollection> list;
    if (is_root)
    {
      list = std::make_unique<meshes::FrameCollection>(folder + "/fine.pvd");
      output->list_earlier_frames(name, first, *list);
    }
    std::vector<double> seconds;
    for (int frame = first; frame <= schedule.n_frames; ++frame)
    {
      progress.begin(title + " reference, frame " + std::to_string(frame), true);
      if (const std::string why = advance(*fine, frame, seconds); !why.empty())
      {
        progress.note(name + ": stops at frame " + std::to_string(frame) + ": " + why);
        verdicts.push_back({title + ": the reference runs to its end (frames reached)",
                            Outcome::inconclusive, static_cast<double>(frame),
                            std::to_string(schedule.n_frames + 1)});
        break;
      }
      const SpacePoints positions  = draped.at_fine_vertices(fine->positions());
      const SpacePoints velocities = fine->velocities();
      const MotionRow motion       = {positions.row(draped.fine_centre_vertex),
                                      fine->kinetic_energy(),
                                      fine->stored_energy(),
                                      std::numeric_limits<double>::quiet_NaN(),
                                      median(seconds),
                                      std::numeric_limits<double>::quiet_NaN()};
      on_root(
        communicator,
        [&]()
        {
          compare(draped, reference, options.methods, runs, frame, positions, bar, *output);
          output->write_motion(draped.cell.name, reference, frame, motion);
          output->write_frame(name, "fine", frame, positions.cast<float>(), draped.fine_triangles(),
                              draped.fine_data(), list.get());
          meshes::write_state({fine->positions(), velocities, fine->time(), frame}, checkpoint);
        });
      if (frame > 0)
        progress.done();
    }
    // A time depends on the machine: reported, never judged.
    double ratio = std::numeric_limits<double>::quiet_NaN();
    for (const CoarseRun &run : runs)
      if (run.is_method())
        ratio = median(seconds) / (run.seconds_per_step + run.seconds_per_upsampling);
    if (std::isfinite(ratio))
      progress.note(title + ": one step takes as long as " + csv_number(ratio) +
                    " coarse steps with up-sampling (1 thread)");
    return {{"reference", reference},
            {"folder", name},
            {"seconds_per_step", json_number(median(seconds))},
            {"coarse_steps_per_step", json_number(ratio)},
            {"ranks", is_dealii(reference) ? n_ranks : 1u},
            {"threads", 1},
            {"dofs", fine->n_dofs()}};
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
                {"duration_s", scene.duration},
                {"integrator", scene.echo.count("Integrator") ? scene.echo.at("Integrator") : ""},
                {"terms", terms},
                {"cells", cell_descriptions},
                {"parameters", scene.echo}};
              study.update(sizes);
              write_whole(options.output + "/verdicts.json",
                          json_text(to_json(verdicts, options.command)));
              write_whole(options.output + "/drape.json", json_text(study));
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
  Progress progress;
  std::unique_ptr<DrapeOutput> output; ///< on the first rank
  nlohmann::ordered_json cell_descriptions = nlohmann::ordered_json::array(), sizes;
  std::vector<Verdict> verdicts;
};
} // namespace

std::vector<Verdict> run_drape_study(const DrapeOptions &options, const MPI_Comm communicator)
{
  return DrapeStudy(options, communicator).run();
}
} // namespace homespun::verification
