// SPDX-License-Identifier: MIT
#include "verification/drape/scene/scene.h"

#include "homogenization/cell/parameter_text.h"
#include "meshes/plain/errors.h"
#include "verification/drape/scene/fabrics.h"
#include "verification/drape/scene/held_place_text.h"
#include "verification/drape/scene/scene_keys.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace homespun::verification
{
using homogenization::Faults;
using homogenization::numbers;
using homogenization::split;
using homogenization::trimmed;

namespace
{
class SceneReader
{
public:
  explicit SceneReader(const std::string &file)
      : file(file)
      , folder(std::filesystem::path(file).parent_path())
  {
  }

  Scene read()
  {
    if (!std::filesystem::is_regular_file(file))
      throw meshes::BadInput(file +
                             ": no such file; expected a scene file (.prm): the shipped ones are "
                             "in meshes/scenes");
    const auto found  = homogenization::keys_set_in(file);
    const auto is_set = [&](const char *key) { return found.count(key) > 0; };
    if (!is_set("Cells") && !is_set("Terms") &&
        (is_set("Young's modulus") || is_set("Orthotropic") || is_set("Length unit")))
      throw meshes::BadInput(file +
                             ": is a cell; expected a scene file (.prm), whose key `Cells` names "
                             "cells: with a shipped scene, `homespun drape meshes/scenes/hang.prm "
                             "--unit-cells " +
                             file + "`");
    homogenization::ParameterKeys declared;
    std::map<std::string, std::string> term_of;
    keys.declare(declared, term_of);
    homogenization::parse_parameters(file, declared, faults);
    if (!faults.empty())
      throw meshes::BadInput(faults);

    scene.file  = file;
    scene.name  = std::filesystem::path(file).stem().string();
    scene.story = keys.story;
    read_terms(declared, term_of);
    read_cloth();
    read_time();
    read_loads();
    read_held();
    read_obstacles();
    if (!faults.empty())
      throw meshes::BadInput(faults);
    return scene;
  }

private:
  void fault(const std::string &key, const std::string &found, const std::string &expected)
  {
    faults.push_back(file + ": key `" + key + "`: found `" + found + "`; expected " + expected);
  }

  TextFault fault_of(const std::string &key)
  {
    return [this, key](const std::string &found, const std::string &expected)
    { fault(key, found, expected); };
  }

  std::vector<double> vector(const std::string &key, const std::string &text,
                             const std::vector<std::size_t> &sizes, const std::string &expected)
  {
    const auto values = numbers(text);
    bool good = values && std::find(sizes.begin(), sizes.end(), values->size()) != sizes.end();
    for (std::size_t k = 0; good && k < values->size(); ++k)
      good = std::isfinite((*values)[k]);
    if (good)
      return *values;
    fault(key, text, expected + homogenization::number_hint(text));
    return std::vector<double>(sizes.front(), 1.);
  }

  double positive(const std::string &key, const std::string &text, const bool zero_too = false)
  {
    const double value =
      vector(key, text, {1}, zero_too ? "zero or a positive number" : "a positive number")[0];
    if (!(value > 0.) && !(zero_too && value == 0.))
    {
      fault(key, text, zero_too ? "zero or a positive number" : "a positive number");
      return 1.;
    }
    return value;
  }

  Eigen::RowVector3d in_space(const std::string &key, const std::string &text)
  {
    const auto v = vector(key, text, {3}, "three numbers");
    return {v[0], v[1], v[2]};
  }

  void read_terms(const homogenization::ParameterKeys &declared,
                  const std::map<std::string, std::string> &term_of)
  {
    std::string names;
    for (const auto &term : all_terms())
      names += (names.empty() ? "" : ", ") + term.first;
    for (const std::string &name : split(keys.terms, ','))
    {
      const bool known = std::any_of(all_terms().begin(), all_terms().end(),
                                     [&](const auto &term) { return term.first == name; });
      if (!known)
        faults.push_back(file + ": key `Terms`: unknown term `" + name + "`; expected some of " +
                         names);
      else
        scene.terms.insert(name);
    }
    if (!scene.has("membrane"))
      faults.push_back(file + ": key `Terms`: `membrane` is missing; expected it in every scene");
    if (scene.has("friction") && !scene.has("obstacles"))
      faults.push_back(file + ": key `Terms`: `friction` without `obstacles`; expected both or "
                              "neither: add `obstacles` or remove `friction`");
    static const std::set<std::string> of_sheets = {"Sheet cells", "Placement", "Centre",
                                                    "Disturbance"};
    const bool is_garment                        = !trimmed(keys.mesh).empty();
    for (const auto &[name, key] : declared.all())
    {
      if (*key.value != key.initial &&
          (is_garment ? of_sheets.count(name) != 0 : name == "Rest coordinate unit"))
        faults.push_back(file + ": key `" + name + "` is of " +
                         (is_garment ? "a sheet, and `Mesh` gives a garment"
                                     : "a garment, and no `Mesh` is given") +
                         "; expected one of both: remove the key");
      const auto term    = term_of.find(name);
      const bool is_used = term == term_of.end() || scene.has(term->second);
      if (is_used)
        scene.echo[name] = *key.value;
      else if (*key.value != key.initial)
        faults.push_back(
          file + ": key `" + name + "` belongs to the term `" + term->second +
          "`, which `Terms` does not list; expected the term there, or remove the key");
    }
  }

  void read_cloth()
  {
    for (const std::string &name : split(keys.cells, ','))
      if (!name.empty())
      {
        const std::string path = (folder / name).lexically_normal().string();
        if (!std::filesystem::is_regular_file(path))
          faults.push_back(file + ": key `Cells`: " + path +
                           " does not exist; expected a cell file");
        scene.cell_files.push_back(path);
      }
    if (scene.cell_files.empty())
      faults.push_back(file + ": key `Cells` is missing; expected at least one cell file");
    const auto cells = vector("Sheet cells", keys.sheet_cells, {2}, "two whole numbers");
    for (const double n : cells)
      if (!(n >= 1.) || n != std::floor(n) || n > 1000.)
      {
        fault("Sheet cells", keys.sheet_cells, "two whole numbers from 1 to 1000");
        break;
      }
    scene.n1 = static_cast<int>(cells[0]);
    scene.n2 = static_cast<int>(cells[1]);
    if (!trimmed(keys.mesh).empty())
    {
      scene.mesh_file = (folder / trimmed(keys.mesh)).lexically_normal().string();
      if (!std::filesystem::is_regular_file(scene.mesh_file))
        faults.push_back(file + ": key `Mesh`: " + scene.mesh_file +
                         " does not exist; expected an OBJ file with `vt`");
    }
    scene.vt_unit = positive("Rest coordinate unit", keys.vt_unit);
    if (keys.placement != "standing" && keys.placement != "lying")
      fault("Placement", keys.placement, "`standing` or `lying`");
    scene.standing    = keys.placement == "standing";
    scene.centre      = in_space("Centre", keys.centre);
    scene.disturbance = vector("Disturbance", keys.disturbance, {1}, "a number")[0];
  }

  void read_time()
  {
    const std::map<std::string, TimeIntegration> kinds = {
      {"linearly implicit", TimeIntegration::linearly_implicit},
      {"implicit", TimeIntegration::implicit},
      {"conserving", TimeIntegration::conserving},
      {"static", TimeIntegration::equilibria}};
    const auto kind = kinds.find(trimmed(keys.integrator));
    if (kind == kinds.end())
      fault("Integrator", keys.integrator,
            "`linearly implicit`, `implicit`, `conserving` or `static`");
    else
      scene.integration = kind->second;
    scene.time_step      = positive("Time step", keys.time_step);
    scene.duration       = positive("Duration", keys.duration);
    scene.frame_interval = positive("Frame interval", keys.frame_interval);
    const double ratio   = scene.frame_interval / scene.time_step;
    if (faults.empty() && scene.integration != TimeIntegration::equilibria &&
        (ratio < 1. - 1e-9 || std::abs(ratio - std::round(ratio)) > 1e-6 * ratio))
      fault("Frame interval", keys.frame_interval, "a multiple of the time step " + keys.time_step);
  }

  void read_bending()
  {
    scene.bending = bending_of_fabric(trimmed(keys.bending));
    if (scene.bending)
      return;
    const auto values =
      vector("Bending stiffness", keys.bending, {1, 4, 6},
             "`cell`, one positive number, D11 D22 D12 D66, these with D16 D26, or "
             "a measured fabric: " +
               names_of_fabrics());
    if (values.size() == 1)
      scene.bending = shell::PlateStiffness::isotropic(values[0], 0.);
    else
      scene.bending = {values[0], values[1], values[2], values[3]};
    if (values.size() == 6)
    {
      scene.bending->D16 = values[4];
      scene.bending->D26 = values[5];
    }
    if (!scene.bending->is_positive_definite())
      fault("Bending stiffness", keys.bending, "a positive stiffness in N m");
  }

  void read_loads()
  {
    scene.gravity      = in_space("Gravity", keys.gravity);
    scene.damping_rate = positive("Damping rate", keys.damping, true);
    scene.viscosity    = positive("Viscosity", keys.viscosity, true);
    if (scene.has("bending") && trimmed(keys.bending) != "cell")
      read_bending();
    scene.wind        = in_space("Wind velocity", keys.wind);
    scene.air_density = positive("Air density", keys.air_density, true);
    scene.drag        = positive("Drag coefficient", keys.drag, true);
    scene.pressure    = vector("Pressure", keys.pressure, {1}, "a number")[0];
  }

  void read_held()
  {
    for (const std::string &text : split(keys.pins, ';'))
      if (!text.empty())
        scene.held.push_back(place_from(text, scene.is_sheet(), fault_of("Pins")));
    if (scene.has("pins") && scene.held.empty())
      faults.push_back(file +
                       ": key `Pins` is missing; expected the places that stay, because `Terms` "
                       "lists pins");
    const std::size_t n_pins = scene.held.size();
    for (const std::string &text : split(keys.handles, ';'))
      if (!text.empty())
        if (auto handle = handle_from(text, scene.is_sheet(), fault_of("Handles")))
          scene.held.push_back(std::move(*handle));
    if (scene.has("handles") && scene.held.size() == n_pins)
      faults.push_back(file + ": key `Handles` is missing; expected the places that move, because "
                              "`Terms` lists handles");
  }

  void read_obstacles()
  {
    for (const std::string &text : split(keys.obstacles, ';'))
    {
      if (text.empty())
        continue;
      std::istringstream words(text);
      SceneObstacle obstacle;
      words >> obstacle.kind;
      const std::map<std::string, std::size_t> sizes = {{"plane", 6}, {"sphere", 4}, {"mesh", 3}};
      const auto size                                = sizes.find(obstacle.kind);
      if (obstacle.kind == "mesh")
      {
        std::string name;
        words >> name;
        obstacle.file = (folder / name).lexically_normal().string();
        if (!std::filesystem::is_regular_file(obstacle.file))
          faults.push_back(file + ": key `Obstacles`: " + obstacle.file +
                           " does not exist; expected an OBJ file of a closed surface");
      }
      std::string rest;
      std::getline(words, rest, '\0');
      const auto values = numbers(rest);
      if (size == sizes.end() || !values || values->size() != size->second)
      {
        fault("Obstacles", text,
              "`plane px py pz nx ny nz`, `sphere cx cy cz radius` or `mesh file.obj dx dy dz`");
        continue;
      }
      obstacle.numbers = *values;
      if (obstacle.kind == "sphere" && !(obstacle.numbers[3] > 0.))
        fault("Obstacles", text, "a positive radius");
      if (obstacle.kind == "plane" &&
          std::hypot(obstacle.numbers[3], obstacle.numbers[4], obstacle.numbers[5]) == 0.)
        fault("Obstacles", text, "a normal that is not zero");
      scene.obstacles.push_back(obstacle);
    }
    if (scene.has("obstacles") && scene.obstacles.empty())
      faults.push_back(file +
                       ": key `Obstacles` is missing; expected at least one, because `Terms` "
                       "lists obstacles");
    scene.friction          = positive("Friction coefficient", keys.friction, true);
    scene.contact_thickness = positive("Contact thickness", keys.thickness);
  }

  const std::string file;
  const std::filesystem::path folder;
  SceneKeys keys;
  Scene scene;
  Faults faults;
};
} // namespace

const std::vector<std::pair<std::string, std::string>> &all_terms()
{
  static const std::vector<std::pair<std::string, std::string>> terms = {
    {"membrane", "in-plane elasticity"},
    {"bending", "elasticity of the plate"},
    {"selvedge", "tension of free edges, in the cloth of the term edges"},
    {"gravity", "weight"},
    {"damping", "against the air at rest, and in the rate of strain"},
    {"wind", "drag and pressure"},
    {"pins", "places that stay"},
    {"handles", "places that move"},
    {"obstacles", "contact"},
    {"friction", "on the obstacles"}};
  return terms;
}

Scene read_scene(const std::string &file)
{
  return SceneReader(file).read();
}

std::string scene_keys()
{
  SceneKeys keys;
  homogenization::ParameterKeys declared;
  std::map<std::string, std::string> term_of;
  keys.declare(declared, term_of);
  return declared.documented();
}
} // namespace homespun::verification
