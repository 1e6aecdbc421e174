// SPDX-License-Identifier: MIT
#include "verification/drape/drape_inputs.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/yarn_axes.h"
#include "verification/cell/study_inputs.h"
#include "verification/drape/draped_cell.h"
#include "verification/laws/default_law.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
/// Hash of a file's content.
std::string fingerprint_of_file(const std::string &path)
{
  std::ifstream input(path, std::ios::binary);
  return fingerprint(
    std::string((std::istreambuf_iterator<char>(input)), std::istreambuf_iterator<char>()));
}
} // namespace

bool is_dealii(const std::string &reference)
{
  return reference != "shell";
}

bool asks_for(const DrapeOptions &options, const std::function<bool(const Method &)> &is_of_it)
{
  return std::any_of(options.methods.begin(), options.methods.end(),
                     [&](const std::string &name) { return is_of_it(Method(name)); });
}

MembraneModel default_model(const UnitCell &cell, const Eigen::Matrix3d &stiffness)
{
  return default_law(cell) == Law::yarn && meshes::yarn_axes(stiffness).are_there
           ? MembraneModel::woven
           : MembraneModel::corotational;
}

std::string note_on_default_model(const UnitCell &cell, const MembraneModel model)
{
  return note_on_default_law(cell) + "; the moving cloth is " + name_of(model);
}

std::vector<std::string> cloths_of(const DrapeOptions &options, const MembraneModel main)
{
  std::vector<std::string> names = options.variants;
  if (names.empty())
    names.push_back(name_of(main));
  for (const std::string &name : options.methods)
    if (has_own_cloth(Method(name)))
      names.push_back(name);
  return names;
}

std::optional<meshes::CellEdges> edges_for(const DrapeOptions &options, const UnitCell &cell,
                                           const AssessedCell &assessed)
{
  if (!needs_of(options).edges)
    return {};
  if (!assessed.edges->edges)
    throw meshes::BadInput("--methods edges: " + cell.name + ": " + assessed.edges->why_not +
                           "; expected a cell with terms of edges: leave the method out");
  return assessed.edges->edges;
}

CellNeeds needs_of(const DrapeOptions &options)
{
  CellNeeds needs;
  needs.edges = asks_for(options, [](const Method &method) { return method.has_edge_terms(); });
  if (asks_for(options, [](const Method &method) { return method.is_of_second_order(); }))
    needs.second_order = {meshes::Law::biot};
  return needs;
}

namespace
{
/// Faults of the methods that have cloths of their own.
void check_methods(const DrapeOptions &options, const Scene &scene,
                   std::vector<std::string> &faults)
{
  const bool edges = asks_for(options, [](const Method &of) { return of.has_edge_terms(); });
  if (edges && !scene.is_sheet())
    faults.push_back("--methods edges: scene `" + scene.name +
                     "` is a garment, whose outlines and seams are no lattice lines; expected a "
                     "sheet: leave the method out");
  else if (edges && !scene.has("selvedge"))
    faults.push_back(scene.file + ": key `Terms`: --methods edges asks for the term `selvedge`, "
                                  "which is not listed; expected it there: slip of clamped edges "
                                  "without tension of free ones can do harm");
  if (!edges && scene.has("selvedge"))
    faults.push_back(
      scene.file + ": key `Terms` lists `selvedge`, and no method takes it; expected "
                   "`edges`, `full` or `first-order` among --methods, or a scene without the term");
  for (const std::string &name : options.methods)
  {
    const Method method(name);
    if (method.has_fitted_modes())
      faults.push_back("--methods " + name +
                       ": its modes are fitted by `homespun strain` alone; expected quadratic, or "
                       "another method");
    if (scene.integration == TimeIntegration::conserving &&
        (method.is_of_second_order() || method.has_six_nodes()))
      faults.push_back("--methods " + name + ": scene `" + scene.name +
                       "` has the key `Integrator` = conserving, whose forces over a step are not "
                       "known of this method; expected another integrator");
    if (!scene.is_sheet() && method.is_of_second_order())
      faults.push_back("--methods " + name + ": scene `" + scene.name +
                       "` is a garment, of which up-sampling has no quadratic modes; expected a "
                       "sheet: leave the method out");
    if (!scene.is_sheet() && method.has_six_nodes())
      faults.push_back("--methods " + name + ": scene `" + scene.name +
                       "` is a garment, whose panels six-node triangles do not fill; expected a "
                       "sheet: leave the method out");
    else if (method.has_six_nodes() && (scene.n1 % 2 != 0 || scene.n2 % 2 != 0))
      faults.push_back("--methods " + name + ": scene `" + scene.name + "` has " +
                       std::to_string(scene.n1) + " x " + std::to_string(scene.n2) +
                       " cells; expected even numbers, which six-node triangles two cells wide "
                       "fill: another --cells, or leave the method out");
  }
}
} // namespace

Scene scene_of(const DrapeOptions &options)
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
      if (const MembraneModel model = membrane_model_of(variant); !has_energy(model))
        faults.push_back("--variants " + variant + ": scene `" + scene.name +
                         "` has the key `Integrator` = conserving, which asks for a membrane whose "
                         "forces over a step are known; expected corotational or woven, or another "
                         "integrator");
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
    const CoarseCloth cloth(scene, cell);
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
      DrapedCell(scene, cell, {}).fine_motion();
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
