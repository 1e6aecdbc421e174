// SPDX-License-Identifier: MIT
#include "verification/drape/drape_inputs.h"

#include "meshes/plain/errors.h"
#include "shell/terms/law_terms.h"
#include "verification/cell/study_inputs.h"
#include "verification/drape/draped_cell.h"
#include "verification/ellipticity/default_law.h"
#include "verification/record/checksum.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
/// Hash of a file's content.
std::string fingerprint_of_file(const std::string &path)
{
  std::ifstream input(path, std::ios::binary);
  return checksum_of_text(
    std::string((std::istreambuf_iterator<char>(input)), std::istreambuf_iterator<char>()));
}
} // namespace

bool is_dealii(const std::string &reference)
{
  return reference != "shell";
}

Law law_of_cloth(const UnitCell &cell, const Eigen::Matrix3d &stiffness)
{
  return homogenized_law(default_law(cell), stiffness);
}

CellNeeds needs_of(const DrapeOptions &options, const Scene &scene)
{
  CellNeeds needs;
  std::set<Law> laws;
  for (const std::string &name : options.methods)
  {
    const Method method = used_in(scene, Method(name));
    needs.edges         = needs.edges || method.has(Term::edges);
    for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_coarse_cloth))
      if (method.is_of_second_order(law))
        laws.insert(law);
  }
  needs.second_order.assign(laws.begin(), laws.end());
  return needs;
}

namespace
{
/// Faults of the terms that are asked for by name; those of presets are left out instead.
void check_methods(const DrapeOptions &options, const Scene &scene,
                   std::vector<std::string> &faults)
{
  if (scene.has("selvedge") && !needs_of(options, scene).edges)
    faults.push_back(scene.file + ": key `Terms` lists `selvedge`, and no method takes it; "
                                  "expected one with the term edges among --methods, like full, or "
                                  "a scene without the term");
  for (const std::string &name : options.methods)
    for (const Term term : terms_of_scenes)
      if (const std::string why = why_not(term, scene); Method(name).asks_for(term) && !why.empty())
        faults.push_back("--methods " + name + ": scene `" + scene.name + why);
}
} // namespace

Scene scene_of(const DrapeOptions &options)
{
  Scene scene = read_scene(options.scene_file);
  if (!options.cell_files.empty())
    scene.cell_files = options.cell_files;
  if (options.n_cells > 0 && scene.is_sheet())
  {
    const std::string before  = scene.echo["Sheet cells"];
    scene                     = scaled(scene, options.n_cells);
    scene.echo["Sheet cells"] = std::to_string(scene.n1) + " " + std::to_string(scene.n2);
    scene.echo["Disturbance"] = short_text(scene.disturbance);
    if (scene.has("handles"))
      scene.echo["Handles"] += ", with ways scaled from " + before + " cells";
  }
  if (options.time_step > 0.)
    scene.echo["Time step"] = short_text(scene.time_step = options.time_step);
  if (options.duration > 0.)
    scene.echo["Duration"] = short_text(scene.duration = options.duration);
  return scene;
}

void check_references(const DrapeOptions &options, const Scene &scene)
{
  std::vector<std::string> faults;
  check_methods(options, scene, faults);
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
    // What the error bar would refuse when it is made.
    if (options.n_cells_of_error_bar > 0)
      try
      {
        scaled(scene, std::min(options.n_cells_of_error_bar, scene.n1));
      }
      catch (const meshes::BadInput &fault)
      {
        faults.push_back(
          "--references " + reference +
          " has an error bar on a small sheet, the reference `shell` has none: " + fault.what());
      }
  }
  if (scene.integration == TimeIntegration::equilibria ||
      scene.integration == TimeIntegration::conserving)
    for (const char *term : {"wind", "obstacles"})
      if (scene.has(term))
        faults.push_back(scene.file + ": key `Integrator` = " + scene.echo.at("Integrator") +
                         " with the term `" + term +
                         "`; expected `implicit` or `linearly implicit`");
  if (scene.integration == TimeIntegration::conserving)
    for (const std::string &variant : options.variants)
      if (!membrane_of(variant))
        faults.push_back("--variants " + variant + ": scene `" + scene.name +
                         "` has the key `Integrator` = conserving, which asks for a membrane whose "
                         "forces over a step are known; expected a law, or another integrator");
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

void check_cloth(const DrapeOptions &options, const Scene &scene,
                 const std::vector<UnitCell> &cells)
{
  const bool fine_too = std::any_of(options.references.begin(), options.references.end(),
                                    [](const std::string &name) { return !is_dealii(name); });
  std::vector<std::string> faults;
  for (const UnitCell &cell : cells)
  {
    const CoarseStart cloth(scene, cell);
    for (const HeldPlace &held : scene.held)
      for (const int v : held.vertices)
        if (v >= cloth.mesh.n_vertices())
          faults.push_back(scene.file + ": held vertex " + std::to_string(v) +
                           " does not exist; expected 0 ... " +
                           std::to_string(cloth.mesh.n_vertices() - 1));
    if (!faults.empty())
      throw meshes::BadInput(faults);
    for (const std::string &place : cloth.motion(scene).idle_places(cloth.mesh))
      faults.push_back(scene.file + ": the place `" + place +
                       "` holds no vertex, or those of later places only; expected one that holds "
                       "a part of the cloth: remove it");
    if (!faults.empty())
      throw meshes::BadInput(faults);
    // A garment's cells are cut along its panels alone: not each of its vertices is one of the fine
    // cloth.
    if (fine_too && !scene.is_sheet() &&
        std::any_of(scene.held.begin(), scene.held.end(),
                    [](const HeldPlace &held) { return held.place == "vertices"; }))
    {
      Scene in_plane = scene; // nothing is homogenized yet, D^H neither
      in_plane.terms.erase("bending");
      DrapedCell(in_plane, cell, {}, Law::biot).fine_motion();
    }
  }
}

void check_variant(const Scene &scene, const UnitCell &cell, const Eigen::Matrix3d &stiffness,
                   const Law law)
{
  const Law of_coarse = homogenized_law(law, stiffness);
  if (of_coarse != law)
    throw meshes::BadInput("--variants " + name_of(law) + ": C^H of " + cell.file +
                           " is alike in all directions and has no yarns; expected a cell whose "
                           "C^H has axes, or the law " +
                           name_of(of_coarse));
  try
  {
    shell::law_terms(law, CoarseStart(scene, cell).mesh, nullptr, {stiffness}, 0., {});
  }
  catch (const meshes::BadInput &fault)
  {
    throw meshes::BadInput("--variants " + name_of(law) + ": C^H of " + cell.file + ": " +
                           fault.what());
  }
}

nlohmann::ordered_json rows_of(const Eigen::Matrix3d &m)
{
  return {{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
}

std::vector<std::string> scene_warnings(const Scene &scene)
{
  std::vector<std::string> warnings;
  std::string points;
  for (const HeldPlace &held : scene.held)
    // A corner is named by two words, an edge by one.
    if (held.vertices.size() == 1 ||
        (held.vertices.empty() && held.place.find(' ') != std::string::npos))
      points += (points.empty() ? "`" : ", `") + held.place + "`";
  if (!points.empty())
    warnings.push_back(
      scene.name + ": held at single points (" + points +
      "): a membrane yields to a point force by the logarithm of the mesh width, so that its "
      "motion near them depends on the mesh; hold an edge, or several vertices side by side");
  return warnings;
}

nlohmann::ordered_json drape_inputs(const DrapeOptions &options, const Scene &scene,
                                    const DrapeSchedule &schedule)
{
  nlohmann::ordered_json inputs = {{"scene", scene.echo},
                                   {"time_step", scene.time_step},
                                   {"frames", schedule.n_frames},
                                   {"frame_interval", schedule.interval},
                                   {"sheet_cells", {scene.n1, scene.n2}},
                                   {"variants", options.variants},
                                   {"methods", options.methods},
                                   {"references", options.references},
                                   {"cells_of_error_bar", options.n_cells_of_error_bar},
                                   {"formats", options.frames},
                                   {"costs", options.costs}};
  if (options.keep)
    inputs["keep"] = true;
  if (!scene.is_sheet())
    inputs["meshes"].push_back(fingerprint_of_file(scene.mesh_file));
  for (const SceneObstacle &obstacle : scene.obstacles)
    if (!obstacle.file.empty())
      inputs["meshes"].push_back(fingerprint_of_file(obstacle.file));
  return inputs;
}

nlohmann::ordered_json what_was_left_out(const DrapeOptions &options, const Scene &scene)
{
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  const auto add             = [&](const std::string &what, const std::string &why) {
    all.push_back({{"what", what}, {"why", why}});
  };
  if (options.references.empty())
    add(scene.name + ": full-resolution cloth",
        "--references was not given: nothing is said of the error");
  for (const std::string &reference : options.references)
    if (!is_dealii(reference))
      add(scene.name + ": error bar of the reference " + reference,
          "it has none, and its accuracy is not judged: its meshes have no quadratic elements");
    else if (options.n_cells_of_error_bar == 0)
      add(scene.name + ": error bar of the reference " + reference,
          "--quick leaves it out: accuracy is not judged");
  if (options.frames.empty())
    add(scene.name + ": frames", "--no-frames was given");
  if (!options.costs)
    add(scene.name + ": what absent terms would cost", "--costs was not given");
  return all;
}
} // namespace homespun::verification
