// SPDX-License-Identifier: MIT
#include "verification/drape/drape_study.h"

#include "meshes/files/obj_file.h"
#include "meshes/plain/errors.h"
#include "verification/cell/study_inputs.h"
#include "verification/cell/study_of_cells.h"
#include "verification/drape/drape_inputs.h"
#include "verification/drape/drape_verdicts.h"
#include "verification/drape/kept_frames.h"
#include "verification/drape/obstacle_surface.h"
#include "verification/drape/reference_run.h"
#include "verification/ellipticity/default_law.h"
#include "verification/ellipticity/yarn_cells.h"
#include "verification/record/checksum.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/provenance.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace homespun::verification
{
using homogenization::UnitCell;
using meshes::SpacePoints;

namespace
{
/// The cells of the scene, or those given in their place.
StudyOptions options_of_study(StudyOptions options, const Scene &scene)
{
  options.cell_files = scene.cell_files;
  return options;
}

/// What the term damping of a scene acts against.
std::string damping_of(const Scene &scene)
{
  std::string parts;
  if (scene.damping_rate > 0.)
    parts = "against the air at rest";
  if (scene.viscosity > 0.)
    parts += std::string(parts.empty() ? "" : ", and ") + "in the rate of strain";
  return parts.empty() ? "none: `Damping rate` and `Viscosity` are 0" : parts;
}

class DrapeStudy final : public StudyOfCells
{
public:
  DrapeStudy(const DrapeOptions &options, const Scene &scene, const MPI_Comm communicator)
      : StudyOfCells("drape", options_of_study(options, scene), communicator)
      , options(options)
      , scene(scene)
      , drape{options, DrapeSchedule(scene), communicator,
              Progress(is_root && !options.quiet,
                       static_cast<int>(scene.cell_files.size()) * DrapeSchedule(scene).n_frames *
                         static_cast<int>(cloths_of(options, {},
                                                    [&](const Method &method)
                                                    { return used_in(scene, method); })
                                            .size() +
                                          options.references.size())),
              verdicts}
  {
  }

private:
  void refuse() const override
  {
    check_yarns(cells(), "--references", options.references);
    check_cloth(options, scene, cells());
  }

  nlohmann::ordered_json inputs() override
  {
    return drape_inputs(options, scene, drape.schedule);
  }

  std::vector<OwedClaim> owed() const override
  {
    std::vector<OwedClaim> owed = owed_of_cells(cells());
    for (const UnitCell &cell : cells())
    {
      owed.push_back({"scene-end.cloth", {{"cell", cell.name}}});
      if (scene.is_sheet())
        for (const char *id : {"turned-upsampling", "turned-energy"})
          owed.push_back({id, {{"cell", cell.name}}});
      for (const std::string &reference : options.references)
        owed.push_back({"scene-end.reference", {{"cell", cell.name}, {"reference", reference}}});
    }
    return owed;
  }

  void open_tables() override
  {
    drape.output = std::make_unique<DrapeOutput>(
      options.output, scene.name, drape.schedule.interval, options.frames, options.costs);
  }

  void work() override
  {
    drape.name = checksum_of_text(json_text(with_cells(inputs())));
    if (drape.schedule.duration() < scene.duration * (1. - 1e-6))
      drape.note(scene.name + ": runs for " + short_text(drape.schedule.duration()) + " s of the " +
                 short_text(scene.duration) + " s asked for, whole frames of " +
                 short_text(drape.schedule.interval) + " s");
    if (std::abs(drape.schedule.interval / scene.frame_interval - 1.) > 1e-6)
      drape.note(scene.name + ": frames are " + short_text(drape.schedule.interval) +
                 " s apart, whole time steps, not the " + short_text(scene.frame_interval) +
                 " s of the scene file");
    for (const std::string &warning : scene_warnings(scene))
      drape.note(warning);
    for (const UnitCell &cell : cells())
      check_variants(cell);
    for (const UnitCell &cell : cells())
      study_cell(cell);
  }

  CellNeeds needs() const
  {
    CellNeeds needs = needs_of(options, scene);
    needs.bending   = scene.has("bending") && !scene.bending;
    return needs;
  }

  /// Of all cells before the first one moves.
  void check_variants(const UnitCell &cell)
  {
    if (options.variants.empty())
      return;
    drape.progress.milestone(cell.name + ": homogenization");
    std::vector<Verdict> told_later;
    const Eigen::Matrix3d C = homogenize(cell, needs(), told_later).result.stiffness;
    for (const std::string &variant : options.variants)
      if (const std::optional<Law> law = membrane_of(variant))
        check_variant(scene, cell, C, *law);
  }

  void study_cell(const UnitCell &cell)
  {
    drape.progress.milestone(cell.name + ": homogenization");
    const CellNeeds needed       = needs();
    const AssessedCell &assessed = homogenize(cell, needed, verdicts);
    const Eigen::Matrix3d &C     = assessed.result.stiffness;
    const Law law =
      options.variants.empty() ? law_of_cloth(cell, C) : law_of(options.variants.front());
    const DrapedCell draped(scene, cell, homogenized_cell(cell, assessed, provenance_line()), law,
                            needed.edges ? assessed.edges->edges : std::nullopt);
    main_variants[cell.name] = name_of(law);
    write_notes_on_laws(draped);
    write_notes_on_methods(draped, needed.edges ? assessed.edges->why_not : "");
    if (draped.edges)
      drape.note(cell.name + ": " + sentence_of_edges(draped.kinds_of_edges()));
    nlohmann::ordered_json description = description_of(draped);

    CoarseRuns coarse;
    on_root(communicator,
            [&]()
            {
              write_obstacles(draped);
              if (options.keep)
                keep_cloth(options.output, draped);
              add(checks_of_scene(draped));
              for (const CoarseCloth &cloth : cloths_of_cell(draped))
              {
                coarse.all.push_back(
                  run_coarse(draped, cloth, drape.schedule, *drape.output, drape.progress));
                judge(draped, coarse.all.back());
                description["runs"].push_back(coarse.all.back().description);
              }
              if (options.costs)
                measure_term_costs(draped, *drape.output, drape.progress);
              if (!options.references.empty())
                coarse.comparison =
                  std::make_unique<DrapeComparison>(draped, options.methods, coarse.all);
            });
    for (const std::string &reference : options.references)
      description["references"].push_back(run_reference(drape, draped, reference, coarse));
    cell_descriptions.push_back(description);
  }

  /// What of the methods is left out, and why.
  void write_notes_on_methods(const DrapedCell &draped, const std::string &why_no_edges)
  {
    for (const std::string &name : options.methods)
    {
      const Method method(name), used = draped.used(method);
      for (const Term term : terms_of_scenes)
        if (const std::string why = why_not(term, scene, draped.law);
            method.has(term) && !used.has(term))
          drape.note(draped.cell.name + ": method " + name + " without " + name_of(term) +
                     (why.empty() ? term == Term::curved
                                      ? ": the cell has no deflection of a bent sheet"
                                      : ": " + why_no_edges
                                  : ": scene `" + scene.name + why));
    }
  }

  std::vector<CoarseCloth> cloths_of_cell(const DrapedCell &draped) const
  {
    return cloths_of(options, draped.law,
                     [&](const Method &method) { return draped.used(method); });
  }

  void write_notes_on_laws(const DrapedCell &draped)
  {
    if (options.variants.empty())
      drape.note(note_on_default_law(draped.cell) + "; the moving cloth has the law " +
                 name_of(draped.law));
    for (const std::string &note : notes_on_yarns(draped.cell, options.references))
      drape.note(note);
    std::set<Law> laws;
    for (const CoarseCloth &cloth : cloths_of_cell(draped))
      if (cloth.law && laws.insert(*cloth.law).second)
        if (const std::string note = note_on_coarse_cloth(*cloth.law, draped.homogenized.stiffness);
            !note.empty())
          drape.note(draped.cell.name + ": " + note);
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
      {"law", name_of(draped.law)},
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
    const std::string title = draped.cell.name + ", " + run.cloth.variant;
    verdicts.push_back(
      verdict_of_cloth(draped.cell.name, run.cloth.variant, run.is_main || run.cloth.is_of_method,
                       static_cast<int>(run.frames.size()), drape.schedule.n_frames + 1));
    if (!run.failure.empty())
      drape.notes.push_back(title + ": " + run.failure);
    if (const std::string waves = sentence_of(run.waves, run.frames.size()); !waves.empty())
      drape.note(title + ": " + waves);
  }

  StudyDescription conclude() override
  {
    nlohmann::ordered_json terms = nlohmann::ordered_json::array();
    for (const auto &[term, what] : all_terms())
      terms.push_back(
        {{"name", term},
         {"present", scene.has(term)},
         {scene.has(term) ? "parameters" : "why", !scene.has(term)    ? "the scene does not list it"
                                                  : term == "damping" ? damping_of(scene)
                                                                      : what}});
    for (nlohmann::ordered_json &cell : cell_descriptions)
      cell["judged_method"] = judged_method(drape.output->error_rows(), cell["cell"]);
    for (const std::string &line : drape.output->worst_errors(main_variants))
      drape.progress.note(line);
    std::map<std::string, std::string> parameters = scene.echo;
    if (!options.cell_files.empty())
      parameters["Cells"].clear();
    for (const std::string &file : options.cell_files)
      parameters["Cells"] += (parameters["Cells"].empty() ? "" : ", ") + file;
    nlohmann::ordered_json told = {
      {"scene", scene.name},
      {"story", scene.story},
      {"time_step_s", scene.time_step},
      {"duration_s", drape.schedule.duration()},
      {"integrator", scene.echo.count("Integrator") ? scene.echo.at("Integrator") : ""},
      {"terms", terms},
      {"cells", cell_descriptions},
      {"parameters", parameters}};
    told.update(sizes);
    return {told, what_was_left_out(options, scene), drape.notes, "drape.json"};
  }

  const DrapeOptions options;
  const Scene scene;
  DrapeRun drape;
  std::map<std::string, std::string> main_variants; ///< of each cell
  nlohmann::ordered_json cell_descriptions = nlohmann::ordered_json::array(), sizes;
};
} // namespace

std::vector<Verdict> run_drape_study(const DrapeOptions &options, const MPI_Comm communicator)
{
  const Scene scene = scene_of(options);
  check_references(options, scene);
  return DrapeStudy(options, scene, communicator).run();
}
} // namespace homespun::verification
