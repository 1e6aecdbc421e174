// SPDX-License-Identifier: MIT
#include "homogenization/unit_cell.h"

#include "homogenization/cell_mesh_file.h"
#include "homogenization/parameter_text.h"
#include "meshes/errors.h"

#include <deal.II/base/parameter_handler.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace homespun::homogenization
{
namespace
{
/// The keys of a cell file; every key is said here once.
struct CellKeys
{
  std::string mesh;
  std::string length_unit = "0.01";
  std::string young, poisson, thickness, density, orthotropic;
  std::string lattice = "auto";

  void declare(dealii::ParameterHandler &keys)
  {
    keys.add_parameter(
      "Mesh", mesh,
      "Mesh of one periodic cell, a path relative to this file; anything deal.II's GridIn "
      "reads, with triangles or quadrilaterals.");
    keys.add_parameter("Length unit", length_unit,
                       "Metres per mesh unit [m], positive; 0.01 for a mesh in centimetres.");
    keys.add_parameter(
      "Young's modulus", young,
      "[Pa] One value per group of the mesh, `group: value, ...`; a group is a physical name "
      "or number.");
    keys.add_parameter("Poisson's ratio", poisson,
                       "[-] One value per group, strictly between -1 and 1.");
    keys.add_parameter("Thickness", thickness, "[m] One value per group.");
    keys.add_parameter("Density", density, "[kg/m^3] One value per group.");
    keys.add_parameter(
      "Orthotropic", orthotropic,
      "`group: E1 E2 nu12 G12 angle, ...` in [Pa], [Pa], [-], [Pa] and [deg] from the x axis to "
      "the first axis of the material; replaces Young's modulus and Poisson's ratio for that "
      "group.");
    keys.add_parameter(
      "Lattice vectors", lattice,
      "`auto` finds the sides of a parallelogram; or `x1 y1; x2 y2` in mesh units.");
  }
};

/// `group: values, ...` as a map; malformed entries become faults.
std::map<std::string, std::vector<double>> group_values(const std::string &file,
                                                        const std::string &key,
                                                        const std::string &text,
                                                        const std::size_t n_values, Faults &faults)
{
  std::map<std::string, std::vector<double>> values;
  for (const std::string &entry : split(text, ','))
  {
    const std::size_t colon = entry.rfind(':');
    const std::string group = trimmed(entry.substr(0, colon));
    const auto parsed =
      colon == std::string::npos ? std::nullopt : numbers(entry.substr(colon + 1));
    if (group.empty() || !parsed || parsed->size() != n_values)
      faults.push_back(file + ": key `" + key + "`: found `" + entry + "`; expected `group: " +
                       (n_values == 1 ? "value" : "E1 E2 nu12 G12 angle") + "`");
    else if (!values.emplace(group, *parsed).second)
      faults.push_back(file + ": key `" + key + "`: group `" + group +
                       "` is given twice; expected once");
  }
  return values;
}

meshes::Lattice lattice_from(const std::string &file, const CellKeys &keys,
                             const double length_unit, const meshes::TriangleMesh &mesh,
                             Faults &faults)
{
  meshes::Lattice lattice;
  if (trimmed(keys.lattice) == "auto")
  {
    try
    {
      lattice = meshes::lattice_of_outline(mesh);
    }
    catch (const meshes::BadInput &fault)
    {
      faults.push_back(file + ": key `Lattice vectors` = auto: " + fault.what());
    }
    return lattice;
  }
  const std::vector<std::string> rows = split(keys.lattice, ';');
  bool good                           = rows.size() == 2;
  for (std::size_t r = 0; good && r < 2; ++r)
  {
    const auto row = numbers(rows[r]);
    good           = row && row->size() == 2;
    if (good)
      lattice.vectors.row(static_cast<Eigen::Index>(r)) << (*row)[0], (*row)[1];
  }
  if (!good)
    faults.push_back(file + ": key `Lattice vectors`: found `" + keys.lattice +
                     "`; expected `auto` or two vectors in mesh units like `1 0; 0.5 0.866`");
  lattice.vectors *= length_unit;
  if (good && lattice.vectors.determinant() < 0.)
    faults.push_back(
      file + ": key `Lattice vectors`: found `" + keys.lattice +
      "`, with the second vector to the right of the first; expected it to the left: "
      "exchange the two");
  return lattice;
}

/// Gives every group of the mesh its phase; renumbers mesh.material to indices into the phases.
std::vector<Phase> assign_phases(const std::string &file, const CellKeys &keys,
                                 CellMeshFile &mesh_file, Faults &faults)
{
  const auto young       = group_values(file, "Young's modulus", keys.young, 1, faults);
  const auto poisson     = group_values(file, "Poisson's ratio", keys.poisson, 1, faults);
  const auto thickness   = group_values(file, "Thickness", keys.thickness, 1, faults);
  const auto density     = group_values(file, "Density", keys.density, 1, faults);
  const auto orthotropic = group_values(file, "Orthotropic", keys.orthotropic, 5, faults);

  const std::set<int> present(mesh_file.mesh.material.data(),
                              mesh_file.mesh.material.data() + mesh_file.mesh.material.size());
  const auto name_of = [&](const int number)
  {
    for (const auto &[name, its_number] : mesh_file.number_of_name)
      if (its_number == number)
        return name;
    return std::to_string(number);
  };
  std::string groups;
  for (const int number : present)
    groups += (groups.empty() ? "`" : ", `") + name_of(number) + "`";

  // A group may be called by its name or by its number.
  const auto find = [&](const auto &values, const int number)
  {
    const auto by_name = values.find(name_of(number));
    return by_name != values.end() ? by_name : values.find(std::to_string(number));
  };
  using GroupValues = std::map<std::string, std::vector<double>>;
  const std::vector<std::pair<const char *, const GroupValues *>> tables = {
    {"Young's modulus", &young},
    {"Poisson's ratio", &poisson},
    {"Thickness", &thickness},
    {"Density", &density},
    {"Orthotropic", &orthotropic}};
  for (const auto &[key, values] : tables)
    for (const auto &entry : *values)
    {
      const bool known = std::any_of(present.begin(), present.end(),
                                     [&](const int number) {
                                       return entry.first == name_of(number) ||
                                              entry.first == std::to_string(number);
                                     });
      if (!known)
        faults.push_back(file + ": key `" + key + "` names the group `" + entry.first +
                         "`, which no triangle of the mesh has; expected one of " + groups);
    }

  std::vector<Phase> phases;
  std::map<int, int> phase_of;
  for (const int number : present)
  {
    Phase phase;
    bool complete   = true;
    const auto take = [&](const char *key, const auto &values)
    {
      const auto entry = find(values, number);
      if (entry != values.end())
        return entry->second[0];
      faults.push_back(file + ": group `" + name_of(number) +
                       "` of the mesh has no value in key `" + key + "`; expected `" +
                       name_of(number) + ": value` there");
      complete = false;
      return 1.;
    };
    const auto yarn = find(orthotropic, number);
    phase.name      = name_of(number);
    if (yarn != orthotropic.end())
    {
      const std::vector<double> &values = yarn->second;
      phase = {phase.name, values[0], values[1], values[2], values[3], values[4], 0., 0.};
      if (find(young, number) != young.end() || find(poisson, number) != poisson.end())
        faults.push_back(
          file + ": group `" + phase.name +
          "` is given both in `Orthotropic` and in `Young's modulus` or `Poisson's ratio`; "
          "expected one of them: remove the other");
    }
    else
    {
      const double E = take("Young's modulus", young), nu = take("Poisson's ratio", poisson);
      phase = isotropic(phase.name, E, nu, 0., 0.);
    }
    phase.thickness = take("Thickness", thickness);
    phase.density   = take("Density", density);
    if (complete)
      for (const std::string &fault : faults_of(phase))
        faults.push_back(file + ": " + fault);
    phase_of[number] = static_cast<int>(phases.size());
    phases.push_back(phase);
  }
  for (int &number : mesh_file.mesh.material)
    number = phase_of[number];
  return phases;
}
} // namespace

namespace
{
/// The path of a file that a cell file names. It stays in the folder of the cell file, links followed, so that a cell
/// from elsewhere opens nothing but what came with it.
/// @throws BadInput where it leads out of the folder
std::string file_beside(const std::string &prm_file, const std::string &name)
{
  const std::filesystem::path folder = std::filesystem::path(prm_file).parent_path(),
                              path   = folder / name;
  const std::filesystem::path within = std::filesystem::weakly_canonical(path).lexically_relative(
    std::filesystem::weakly_canonical(folder.empty() ? "." : folder));
  if (std::filesystem::path(name).is_absolute() || within.empty() || *within.begin() == "..")
    throw meshes::BadInput(
      prm_file + ": key `Mesh`: found `" + name +
      "`, which lies outside of the folder of the cell file; expected a file in it or below: "
      "copy the mesh there");
  return path.string();
}
} // namespace

std::vector<Eigen::Matrix3d> UnitCell::stiffness_of_phase() const
{
  std::vector<Eigen::Matrix3d> stiffness;
  for (const Phase &phase : phases)
    stiffness.push_back(plane_stress_stiffness(phase));
  return stiffness;
}

double UnitCell::areal_density() const
{
  const Eigen::VectorXd areas = meshes::signed_areas(mesh);
  double mass                 = 0.;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const Phase &phase = phases[static_cast<std::size_t>(mesh.material(t))];
    mass += areas(t) * phase.thickness * phase.density;
  }
  return mass / lattice.area();
}

UnitCell read_unit_cell(const std::string &prm_file)
{
  if (!std::filesystem::is_regular_file(prm_file))
    throw meshes::BadInput(prm_file +
                           ": no such file; expected a cell file (.prm): `homespun cells` lists "
                           "the shipped ones");
  Faults faults;
  CellKeys keys;
  dealii::ParameterHandler handler;
  keys.declare(handler);
  parse_parameters(prm_file, handler, faults);
  const auto unit = numbers(keys.length_unit);
  const bool unit_is_sound =
    unit && unit->size() == 1 && (*unit)[0] > 0. && std::isfinite((*unit)[0]);
  if (!unit_is_sound)
    faults.push_back(prm_file + ": key `Length unit`: found `" + keys.length_unit +
                     "`; expected metres per mesh unit as one positive number like `0.01`");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  const double length_unit = (*unit)[0];

  UnitCell cell;
  cell.file = prm_file;
  cell.name = std::filesystem::path(prm_file).stem().string();
  if (trimmed(keys.mesh).empty())
    throw meshes::BadInput(prm_file + ": key `Mesh` is missing; expected the mesh of one cell");
  const std::string mesh_path = file_beside(prm_file, trimmed(keys.mesh));
  CellMeshFile mesh_file      = read_cell_mesh(mesh_path);
  mesh_file.mesh.vertices *= length_unit;

  faults      = meshes::faults_of(mesh_file.mesh, mesh_path);
  cell.phases = assign_phases(prm_file, keys, mesh_file, faults);
  cell.mesh   = std::move(mesh_file.mesh);
  try
  {
    const std::size_t n_before = faults.size();
    cell.lattice               = lattice_from(prm_file, keys, length_unit, cell.mesh, faults);
    if (faults.size() == n_before)
      for (const std::string &fault :
           meshes::periodicity_faults(cell.mesh, cell.lattice, mesh_path))
        faults.push_back(fault);
  }
  catch (const meshes::BadInput &fault)
  {
    faults.push_back(mesh_path + ": " + fault.what());
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return cell;
}

std::string unit_cell_keys()
{
  CellKeys keys;
  dealii::ParameterHandler handler;
  keys.declare(handler);
  std::ostringstream text;
  handler.print_parameters(text, dealii::ParameterHandler::PRM);
  return text.str();
}
} // namespace homespun::homogenization
