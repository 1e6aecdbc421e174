// SPDX-License-Identifier: MIT
#include "verification/drape_study.h"

#include "meshes/errors.h"
#include "meshes/fine_cloth.h"
#include "meshes/obj_file.h"
#include "meshes/state_file.h"
#include "meshes/surface_files.h"
#include "verification/cell_output.h"
#include "verification/cloth_reference.h"
#include "verification/draped_cell.h"
#include "verification/lightweight_cloth.h"
#include "verification/on_root.h"
#include "verification/progress.h"
#include "verification/provenance.h"
#include "verification/result_files.h"
#include "verification/scene_cloth.h"
#include "verification/study_inputs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

namespace homespun::verification
{
using homogenization::UnitCell;
using meshes::SpacePoints;

namespace
{
const std::vector<std::string> error_columns  = {"scene",
                                                 "cell",
                                                 "variant",
                                                 "reference",
                                                 "method",
                                                 "frame",
                                                 "time_s",
                                                 "error_mean_m",
                                                 "error_rms_m",
                                                 "error_max_m",
                                                 "error_mean_per_cell",
                                                 "error_mean_per_fluctuation",
                                                 "reference_uncertainty_m"};
const std::vector<std::string> motion_columns = {"scene",
                                                 "cell",
                                                 "variant",
                                                 "frame",
                                                 "time_s",
                                                 "centre_x_m",
                                                 "centre_y_m",
                                                 "centre_z_m",
                                                 "kinetic_J",
                                                 "stored_J",
                                                 "max_stretch",
                                                 "seconds_coarse_step",
                                                 "seconds_upsampling"};
const std::vector<std::string> term_columns   = {
    "scene", "cell",        "term", "present", "seconds_per_step", "seconds_per_step_forced",
    "bytes", "bytes_forced"};

double median(std::vector<double> values)
{
  if (values.empty())
    return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double seconds_since(const std::chrono::steady_clock::time_point begin)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

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
      , n_frames(static_cast<int>(std::floor(scene.duration / scene.frame_interval + 1e-9)))
      , steps_per_frame(static_cast<int>(std::lround(scene.frame_interval / scene.time_step)))
      , progress(is_root && !options.quiet,
                 static_cast<int>(scene.cell_files.size()) * n_frames *
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
    // Refuses a cloth that makes no sense before any file is written.
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
    on_root(communicator, [&]() { open_tables(cells); });
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

  void open_tables(const std::vector<UnitCell> &cells)
  {
    std::filesystem::create_directories(options.output);
    check_drape_inputs(cells);
    const auto open =
      [&](const char *name, const std::vector<std::string> &columns, const std::size_t n_keys)
    {
      return std::make_unique<ResultTable>(options.output + "/" + name, columns, n_keys,
                                           options.resume);
    };
    error_table  = open("drape.csv", error_columns, 6);
    motion_table = open("motion.csv", motion_columns, 4);
    if (options.costs)
      term_table = open("terms.csv", term_columns, 3);
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
    const meshes::HomogenizedCell homogenized =
      homogenization::homogenized_cell(cell, assessed.result, provenance_line());
    const DrapedCell draped(scene, cell, homogenized);
    nlohmann::ordered_json description = {
      {"cell", cell.name},
      {"cell_side_m", draped.side},
      {"C",
       {{homogenized.stiffness(0, 0), homogenized.stiffness(0, 1), homogenized.stiffness(0, 2)},
        {homogenized.stiffness(1, 0), homogenized.stiffness(1, 1), homogenized.stiffness(1, 2)},
        {homogenized.stiffness(2, 0), homogenized.stiffness(2, 1), homogenized.stiffness(2, 2)}}},
      {"areal_density", homogenized.areal_density},
      {"runs", nlohmann::ordered_json::array()},
      {"references", nlohmann::ordered_json::array()}};
    coarse_triangles = draped.coarse.n_triangles();
    fine_triangles   = draped.fine.n_triangles();
    fine_vertices    = draped.n_fine();

    std::vector<CoarseRun> runs;
    on_root(communicator,
            [&]()
            {
              for (const std::string &variant : options.variants)
                runs.push_back(run_coarse(draped, variant, description["runs"]));
              if (options.costs)
                measure_costs(draped);
            });
    for (const std::string &reference : options.references)
      run_reference(draped, reference, runs, description["references"]);
    cell_descriptions.push_back(description);
  }

  /// A frame on the disk, listed in the collection.
  void write_frame(const std::string &folder, const std::string &what, const int frame,
                   const meshes::FloatPoints &positions, const meshes::Triangles &triangles,
                   const std::vector<meshes::VertexData> &data,
                   meshes::FrameCollection *collection) const
  {
    char number[16];
    std::snprintf(number, sizeof(number), "%04d", frame);
    for (const std::string &format : options.frames)
    {
      const std::string name = what + "_" + number + "." + format;
      const std::string path = folder + "/" + name;
      if (format == "ply")
        meshes::write_ply(path, positions, triangles);
      else if (format == "obj")
        meshes::write_obj(path, positions.cast<double>(), triangles);
      else
      {
        meshes::write_vtu(path, positions, triangles, data);
        if (collection)
          collection->append(frame * scene.frame_interval, name);
      }
    }
  }

  void write_motion(const DrapedCell &draped, const std::string &variant, const int frame,
                    const Eigen::RowVector3d &centre, const double kinetic, const double stored,
                    const double stretch, const double step, const double upsampling)
  {
    const std::vector<std::string> keys = {scene.name, draped.cell.name, variant,
                                           std::to_string(frame)};
    if (motion_table->contains(keys))
      return;
    std::vector<std::string> row = keys;
    for (const double value : {frame * scene.frame_interval, centre(0), centre(1), centre(2),
                               kinetic, stored, stretch, step, upsampling})
      row.push_back(csv_number(value));
    motion_table->append(row);
  }

  /// The coarse cloth over all frames. Takes seconds, and is computed again when a study is resumed.
  CoarseRun run_coarse(const DrapedCell &draped, const std::string &variant,
                       nlohmann::ordered_json &descriptions)
  {
    CoarseRun run;
    run.variant                 = variant;
    const std::string name      = draped.cell.name + "-" + variant;
    const std::string folder    = options.output + "/" + name;
    const bool is_method        = variant == "corotational";
    const Upsampler3f upsampler = draped.upsampler<float>(Method("localized"));
    std::filesystem::create_directories(folder);
    meshes::FrameCollection coarse_list(folder + "/coarse.pvd"), fine_list(folder + "/fine.pvd");
    std::vector<double> step_seconds, upsampling_seconds;
    int cuts = 0, steps = 0;
    Upsampler3f::Fine fine;
    SceneCloth moving(scene, draped.coarse, draped.effective, draped.coarse_motion(),
                      membrane_model_of(variant));
    for (int frame = 0; frame <= n_frames; ++frame)
    {
      progress.begin(draped.cell.name + ", " + variant + " cloth, frame " + std::to_string(frame));
      try
      {
        const int n = frame == 0                                         ? 0
                      : scene.integration == TimeIntegration::equilibria ? 1
                                                                         : steps_per_frame;
        for (int k = 0; k < n; ++k, ++steps)
        {
          auto begin = std::chrono::steady_clock::now();
          if (scene.integration == TimeIntegration::equilibria)
            moving.solve_equilibrium(frame * scene.frame_interval);
          else
            cuts += moving.step(scene.time_step).cuts;
          step_seconds.push_back(seconds_since(begin));
          begin = std::chrono::steady_clock::now();
          upsampler.upsample(moving.cloth().positions(), fine);
          upsampling_seconds.push_back(seconds_since(begin));
        }
        if (n == 0)
          upsampler.upsample(moving.cloth().positions(), fine);
      }
      catch (const meshes::NotConverged &failure)
      {
        run.failure = failure.what();
        progress.note(name + ": " + run.failure);
        break;
      }
      run.frames.push_back(moving.cloth().positions());
      write_motion(draped, variant, frame, run.frames.back().row(draped.centre_vertex),
                   moving.cloth().kinetic_energy(), moving.cloth().stored_energy(),
                   largest_stretch(draped.coarse, run.frames.back()), median(step_seconds),
                   median(upsampling_seconds));
      // Of the variants one picture is enough: the report shows their curves.
      if (is_method || frame == n_frames)
      {
        write_frame(folder, "coarse", frame, run.frames.back().cast<float>(),
                    draped.coarse.triangles, {}, &coarse_list);
        write_frame(folder, "fine", frame, fine, draped.fine_triangles(), draped.fine_data(),
                    &fine_list);
      }
      if (frame > 0)
        progress.done();
    }
    run.seconds_per_step       = median(step_seconds);
    run.seconds_per_upsampling = median(upsampling_seconds);
    descriptions.push_back({{"variant", variant},
                            {"folder", name},
                            {"frames", run.frames.size()},
                            {"steps", steps},
                            {"cut_steps", cuts},
                            {"seconds_per_coarse_step", json_number(run.seconds_per_step)},
                            {"seconds_per_upsampling", json_number(run.seconds_per_upsampling)},
                            {"bytes", moving.cloth().bytes()},
                            {"threads", 1}});
    verdicts.push_back(
      {draped.cell.name + ", " + variant + ": the scene runs to its end (frames reached)",
       static_cast<int>(run.frames.size()) == n_frames + 1 ? Outcome::pass
       : is_method                                         ? Outcome::fail
                                                           : Outcome::inconclusive,
       static_cast<double>(run.frames.size()), std::to_string(n_frames + 1)});
    return run;
  }

  /// What a scene would pay per step, and in memory, for each term that it does not have.
  void measure_costs(const DrapedCell &draped)
  {
    const auto measured = [&](const std::set<std::string> &forced)
    {
      SceneCloth moving(scene, draped.coarse, draped.effective, draped.coarse_motion(),
                        MembraneModel::corotational, forced);
      std::vector<double> seconds;
      for (int k = 0; k < 60; ++k)
      {
        const auto begin = std::chrono::steady_clock::now();
        moving.step(scene.time_step);
        seconds.push_back(seconds_since(begin));
      }
      return std::make_pair(median(seconds), moving.cloth().bytes());
    };
    for (const std::string &term : terms_that_can_be_forced())
    {
      const std::vector<std::string> keys = {scene.name, draped.cell.name, term};
      if (term_table->contains(keys))
        continue;
      progress.begin(draped.cell.name + ": what `" + term + "` costs");
      const auto [seconds, bytes]  = measured({});
      std::vector<std::string> row = keys;
      const bool present           = scene.has(term);
      const auto [forced_seconds, forced_bytes] =
        present ? std::make_pair(std::numeric_limits<double>::quiet_NaN(), std::size_t(0))
                : measured({term});
      for (const std::string &field : {std::string(present ? "true" : "false"), csv_number(seconds),
                                       csv_number(forced_seconds), std::to_string(bytes),
                                       present ? std::string() : std::to_string(forced_bytes)})
        row.push_back(field);
      term_table->append(row);
    }
  }

  /// A full-resolution cloth over all frames, and the errors of every coarse run against it.
  void run_reference(const DrapedCell &draped, const std::string &reference,
                     const std::vector<CoarseRun> &runs, nlohmann::ordered_json &descriptions)
  {
    const std::string name   = draped.cell.name + "-" + reference;
    const std::string folder = options.output + "/" + name;
    progress.begin(draped.cell.name + ", " + reference + ": setting up", true);
    on_root(communicator, [&]() { std::filesystem::create_directories(folder); });
    std::unique_ptr<FineRun> fine = fine_run(draped, reference);

    ErrorBar bar;
    if (is_dealii(reference) && options.n_cells_of_error_bar > 0)
    {
      progress.begin(draped.cell.name + ", " + reference + ": error bar", true);
      bar = error_bar(draped, reference, std::min(options.n_cells_of_error_bar, scene.n1));
    }
    int first                    = 0;
    const std::string checkpoint = folder + "/checkpoint.h5";
    if (options.resume)
    {
      // Every rank reads the same file.
      if (const auto state = meshes::read_state(checkpoint, fine->n_vertices()))
      {
        fine->resume(*state);
        first = state->frame + 1;
      }
    }
    std::unique_ptr<meshes::FrameCollection> list;
    if (is_root)
      list = std::make_unique<meshes::FrameCollection>(folder + "/fine.pvd");
    for (int frame = 0; is_root && frame < first; ++frame)
    {
      char number[32];
      std::snprintf(number, sizeof(number), "fine_%04d.vtu", frame);
      if (std::filesystem::exists(folder + "/" + number))
        list->append(frame * scene.frame_interval, number);
    }
    std::vector<double> seconds;
    for (int frame = first; frame <= n_frames; ++frame)
    {
      progress.begin(
        draped.cell.name + ", " + reference + " reference, frame " + std::to_string(frame), true);
      std::string why;
      const int n = frame == 0                                         ? 0
                    : scene.integration == TimeIntegration::equilibria ? 1
                                                                       : steps_per_frame;
      for (int k = 0; k < n && why.empty(); ++k)
      {
        const FineStep step = fine->advance(scene.integration == TimeIntegration::equilibria,
                                            scene.time_step, frame * scene.frame_interval);
        why                 = step.why;
        seconds.push_back(step.seconds);
      }
      if (!why.empty())
      {
        progress.note(name + ": stops at frame " + std::to_string(frame) + ": " + why);
        verdicts.push_back(
          {draped.cell.name + ", " + reference + ": the reference runs to its end (frames reached)",
           Outcome::inconclusive, static_cast<double>(frame), std::to_string(n_frames + 1)});
        break;
      }
      const SpacePoints positions  = draped.at_fine_vertices(fine->positions());
      const SpacePoints velocities = fine->velocities();
      const double kinetic = fine->kinetic_energy(), stored = fine->stored_energy();
      on_root(
        communicator,
        [&]()
        {
          compare(draped, reference, runs, frame, positions, bar);
          write_motion(draped, reference, frame, positions.row(draped.fine_centre_vertex), kinetic,
                       stored, std::numeric_limits<double>::quiet_NaN(), median(seconds),
                       std::numeric_limits<double>::quiet_NaN());
          write_frame(folder, "fine", frame, positions.cast<float>(), draped.fine_triangles(),
                      draped.fine_data(), list.get());
          meshes::write_state({fine->positions(), velocities, fine->time(), frame}, checkpoint);
        });
      if (frame > 0)
        progress.done();
    }
    descriptions.push_back({{"reference", reference},
                            {"folder", name},
                            {"seconds_per_step", json_number(median(seconds))},
                            {"ranks", is_dealii(reference) ? n_ranks : 1u},
                            {"threads", 1},
                            {"dofs", fine->n_dofs()}});
    on_root(communicator,
            [&]()
            {
              for (const CoarseRun &run : runs)
                if (run.variant == "corotational" && !seconds.empty())
                  verdicts.push_back(
                    {draped.cell.name +
                       ": steps of the coarse cloth with up-sampling (1 thread) per step "
                       "of the reference `" +
                       reference + "` (" + std::to_string(is_dealii(reference) ? n_ranks : 1u) +
                       (is_dealii(reference) ? " ranks)" : " thread)"),
                     median(seconds) / (run.seconds_per_step + run.seconds_per_upsampling) >= 1000.
                       ? Outcome::pass
                       : Outcome::inconclusive,
                     median(seconds) / (run.seconds_per_step + run.seconds_per_upsampling),
                     ">= 1000"});
            });
  }

  std::unique_ptr<FineRun> fine_run(const DrapedCell &draped, const std::string &reference) const
  {
    if (is_dealii(reference))
      return dealii_run(draped, law_of(reference), 1, communicator);
    return shell_run(draped, communicator);
  }

  /// |P1 − P2| of the same scene on a small sheet, per mean fluctuation there; the discretization error of
  /// a resolved sheet goes with its local strain, as the fluctuation does.
  ErrorBar error_bar(const DrapedCell &draped, const std::string &reference,
                     const int n_cells) const
  {
    const Scene small = scaled(scene, n_cells);
    const DrapedCell sheet(small, draped.cell, draped.homogenized);
    const std::unique_ptr<FineRun> p1 = dealii_run(sheet, law_of(reference), 1, communicator),
                                   p2 = dealii_run(sheet, law_of(reference), 2, communicator);
    SceneCloth coarse(small, sheet.coarse, sheet.effective, sheet.coarse_motion());
    const auto affine = sheet.upsampler<double>(Method("affine"));
    ErrorBar bar;
    for (int frame = 0; frame <= n_frames; ++frame)
    {
      const bool is_static = scene.integration == TimeIntegration::equilibria;
      for (int k = 0; k < (frame == 0 ? 0 : is_static ? 1 : steps_per_frame); ++k)
      {
        if (is_static)
          coarse.solve_equilibrium(frame * scene.frame_interval);
        else
          coarse.step(scene.time_step);
        for (const auto &run : {p1.get(), p2.get()})
          if (!run->advance(is_static, scene.time_step, frame * scene.frame_interval).why.empty())
            return bar; // known up to here
      }
      Upsampler3d::Fine motion;
      affine.upsample(coarse.cloth().positions(), motion);
      bar.difference.push_back((p1->positions() - p2->positions()).rowwise().norm().mean());
      bar.fluctuation.push_back((p2->positions() - motion).rowwise().norm().mean());
    }
    return bar;
  }

  void compare(const DrapedCell &draped, const std::string &reference,
               const std::vector<CoarseRun> &runs, const int frame, const SpacePoints &positions,
               const ErrorBar &bar)
  {
    const auto at      = static_cast<std::size_t>(frame);
    double fluctuation = std::numeric_limits<double>::quiet_NaN();
    for (const CoarseRun &run : runs)
    {
      if (run.frames.size() <= at)
        continue;
      Upsampler3d::Fine up;
      if (run.variant == "corotational")
      {
        draped.upsampler<double>(Method("affine")).upsample(run.frames[at], up);
        fluctuation = (positions - up).rowwise().norm().mean();
        // Where nothing has moved yet, round-off over round-off is no figure.
        if (fluctuation < 1e-12 * draped.side)
          fluctuation = std::numeric_limits<double>::quiet_NaN();
      }
      for (const std::string &name : options.methods)
      {
        const std::vector<std::string> keys = {
          scene.name, draped.cell.name, run.variant, reference, name, std::to_string(frame)};
        const Method method(name);
        draped.upsampler<double>(method).upsample(run.frames[at], up);
        const Eigen::VectorXd distance = (up - positions).rowwise().norm();
        if (!distance.allFinite())
          throw meshes::NotConverged(draped.cell.name + ", " + run.variant + ", " + name +
                                       ": positions that are not finite",
                                     {});
        if (error_table->contains(keys))
          continue;
        std::vector<std::string> row = keys;
        for (const double value :
             {frame * scene.frame_interval, distance.mean(),
              std::sqrt(distance.squaredNorm() / static_cast<double>(distance.size())),
              distance.maxCoeff(), distance.mean() / draped.side,
              fluctuation > 0. ? distance.mean() / fluctuation
                               : std::numeric_limits<double>::quiet_NaN(),
              bar.at(at, fluctuation)})
          row.push_back(csv_number(value));
        error_table->append(row);
        if (run.variant == "corotational" && name == "localized" && !options.frames.empty())
        {
          // The frame again, now with its error.
          std::vector<meshes::VertexData> data = draped.fine_data();
          data.push_back({"error", distance.cast<float>()});
          write_frame(options.output + "/" + draped.cell.name + "-" + run.variant, "fine", frame,
                      up.cast<float>(), draped.fine_triangles(), data, nullptr);
        }
      }
    }
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
              // From the table, so that a resumed run speaks of all its frames.
              std::map<std::string, double> worst_error;
              for (const std::vector<std::string> &row : error_table->rows())
                if (row[2] == "corotational" && row[4] == "localized" && !row[10].empty())
                {
                  double &worst = worst_error[row[1] + " against " + row[3]];
                  worst         = std::max(worst, std::stod(row[10]));
                }
              for (const auto &[what, error] : worst_error)
                progress.note(what + ": largest mean error of `localized` over time " +
                              csv_number(error) + " cell sides");
              const nlohmann::ordered_json study = {
                {"scene", scene.name},
                {"story", scene.story},
                {"command", options.command},
                {"provenance", provenance(n_ranks)},
                {"time_step_s", scene.time_step},
                {"duration_s", scene.duration},
                {"integrator", scene.echo.count("Integrator") ? scene.echo.at("Integrator") : ""},
                {"coarse_triangles", coarse_triangles},
                {"fine_triangles", fine_triangles},
                {"fine_vertices", fine_vertices},
                {"terms", terms},
                {"cells", cell_descriptions},
                {"parameters", scene.echo}};
              write_whole(options.output + "/verdicts.json",
                          json_text(to_json(verdicts, options.command)));
              write_whole(options.output + "/drape.json", json_text(study));
            });
    int failed = any_failed(verdicts);
    MPI_Bcast(&failed, 1, MPI_INT, 0, communicator);
    if (failed && !any_failed(verdicts))
      verdicts.push_back({"the first rank saw a failure", Outcome::fail, 1., "0"});
    return verdicts;
  }

  const DrapeOptions options;
  const MPI_Comm communicator;
  const unsigned int n_ranks;
  const bool is_root;
  const Scene scene;
  const int n_frames, steps_per_frame;
  Progress progress;
  std::unique_ptr<ResultTable> error_table, motion_table, term_table;
  nlohmann::ordered_json cell_descriptions = nlohmann::ordered_json::array();
  std::vector<Verdict> verdicts;
  int coarse_triangles = 0, fine_triangles = 0, fine_vertices = 0;
};
} // namespace

std::vector<Verdict> run_drape_study(const DrapeOptions &options, const MPI_Comm communicator)
{
  return DrapeStudy(options, communicator).run();
}
} // namespace homespun::verification
