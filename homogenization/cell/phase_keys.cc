// SPDX-License-Identifier: MIT
#include "homogenization/cell/cell_keys.h"
#include "homogenization/mesh_files/mesh_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace homespun::homogenization
{
namespace
{
/// Stands for the group of values without a name: the default of all groups.
constexpr const char *no_name = "";

/// `group: values, ...` as a map, of which the first entry may have no name; malformed entries
/// become faults.
std::map<std::string, std::vector<double>> group_values(const std::string &file,
                                                        const std::string &key,
                                                        const std::string &text,
                                                        const std::size_t n_values, Faults &faults)
{
  std::map<std::string, std::vector<double>> values;
  std::string before;
  for (const std::string &entry : split(text, ','))
  {
    const std::size_t colon = entry.rfind(':');
    const std::string group = trimmed(entry.substr(0, colon));
    const auto parsed =
      colon == std::string::npos ? std::nullopt : numbers(entry.substr(colon + 1));
    const auto lone = colon == std::string::npos ? numbers(entry) : std::nullopt;
    if (lone && lone->size() == n_values && before.empty())
      values.emplace(no_name, *lone);
    else if (lone && lone->size() == 1)
      faults.push_back(
        file + ": key `" + key + "`: found `" + before + "," + entry +
        "`; expected a decimal point, not a comma: commas part the groups (a value for "
        "all groups comes first)");
    else if (group.empty() || !parsed || parsed->size() != n_values)
      faults.push_back(file + ": key `" + key + "`: found `" + entry + "`; expected `group: " +
                       (n_values == 1 ? "value" : "E1 E2 nu12 G12 angle") + "`" +
                       (colon == std::string::npos ? "" : number_hint(entry.substr(colon + 1))));
    else if (!values.emplace(group, *parsed).second)
      faults.push_back(file + ": key `" + key + "`: group `" + group +
                       "` is given twice; expected once");
    before = entry;
  }
  return values;
}

/// `group: t E nu, t E nu, ...` as the numbers of each group.
std::map<std::string, std::vector<double>> group_layers(const std::string &file,
                                                        const std::string &text, Faults &faults)
{
  std::map<std::string, std::vector<double>> values;
  std::vector<double> *of_group = nullptr;
  for (const std::string &entry : split(text, ','))
  {
    const std::size_t colon = entry.rfind(':');
    const auto layer        = numbers(colon == std::string::npos ? entry : entry.substr(colon + 1));
    if (colon != std::string::npos)
    {
      const std::string group    = trimmed(entry.substr(0, colon));
      const auto [place, is_new] = values.try_emplace(group);
      of_group                   = &place->second;
      if (!is_new)
        faults.push_back(file + ": key `Layers`: group `" + group +
                         "` is given twice; expected once, with all of its layers behind it");
    }
    if (of_group && layer && layer->size() == 3)
      of_group->insert(of_group->end(), layer->begin(), layer->end());
    else if (!trimmed(text).empty())
      faults.push_back(file + ": key `Layers`: found `" + entry +
                       "`; expected `group: thickness E nu, thickness E nu, ...`, three numbers a "
                       "layer");
  }
  return values;
}

/// A phase for each angle that the triangles of an orthotropic group have on top of that of the
/// group.
void turn_phases(const std::string &file, const std::string &mesh_name,
                 const std::vector<char> &is_orthotropic, CellMeshFile &mesh_file,
                 std::vector<Phase> &phases, Faults &faults)
{
  if (std::find(is_orthotropic.begin(), is_orthotropic.end(), 1) == is_orthotropic.end())
  {
    faults.push_back(
      file + ": the mesh " + mesh_name +
      " has cell data `angle`, and no group is in key `Orthotropic`; expected the group that the "
      "angles are for: add it there, or leave the data out");
    return;
  }
  const std::vector<Phase> groups = std::move(phases);
  phases.clear();
  std::map<std::pair<int, double>, int> phase_of; // by group and angle on top
  for (Eigen::Index t = 0; t < mesh_file.angle.size(); ++t)
  {
    int &material       = mesh_file.mesh.material(t);
    const auto group    = static_cast<std::size_t>(material);
    const double on_top = is_orthotropic[group] ? mesh_file.angle(t) : 0.;
    if (!std::isfinite(on_top))
    {
      faults.push_back(file + ": the mesh " + mesh_name + ": triangle " + std::to_string(t) +
                       " has no finite number as cell data `angle`; expected degrees");
      return;
    }
    const auto [place, is_new] =
      phase_of.emplace(std::pair(material, on_top), static_cast<int>(phases.size()));
    if (is_new)
    {
      phases.push_back(groups[group]);
      phases.back().angle += on_top;
    }
    material = place->second;
  }
}

using GroupValues = std::map<std::string, std::vector<double>>;

/// What the keys say of each group.
struct GroupTables
{
  GroupTables(const std::string &file, const CellKeys &keys, Faults &faults)
      : young(group_values(file, "Young's modulus", keys.young, 1, faults))
      , poisson(group_values(file, "Poisson's ratio", keys.poisson, 1, faults))
      , thickness(group_values(file, "Thickness", keys.thickness, 1, faults))
      , density(group_values(file, "Density", keys.density, 1, faults))
      , orthotropic(group_values(file, "Orthotropic", keys.orthotropic, 5, faults))
      , layers(group_layers(file, keys.layers, faults))
  {
  }
  GroupValues young, poisson, thickness, density, orthotropic;
  GroupValues layers; ///< t E nu of each, one after the other
};

/// The groups that triangles of the mesh have.
struct GroupsOfMesh
{
  explicit GroupsOfMesh(const CellMeshFile &mesh_file)
      : present(mesh_file.mesh.material.data(),
                mesh_file.mesh.material.data() + mesh_file.mesh.material.size())
      , has_names(!mesh_file.number_of_name.empty())
  {
    for (const auto &[name, number] : mesh_file.number_of_name)
      names.emplace(number, name);
    for (const int number : present)
    {
      names.emplace(number, std::to_string(number));
      called.insert({names.at(number), std::to_string(number)});
    }
  }

  const std::string &name_of(const int number) const
  {
    return names.at(number);
  }

  /// Whether a group may be given by its number: not where another one is called that.
  bool goes_by_number(const int number) const
  {
    const std::string text = std::to_string(number);
    return std::none_of(names.begin(), names.end(),
                        [&](const auto &other)
                        { return other.first != number && other.second == text; });
  }

  /// The values that a group is given by its name or by its number; nothing where there are none.
  const std::vector<double> *named(const GroupValues &values, const int number) const
  {
    auto entry = values.find(name_of(number));
    if (entry == values.end() && goes_by_number(number))
      entry = values.find(std::to_string(number));
    return entry == values.end() ? nullptr : &entry->second;
  }

  /// The same, or else the default of all groups.
  const std::vector<double> *find(const GroupValues &values, const int number) const
  {
    if (const std::vector<double> *its = named(values, number))
      return its;
    const auto entry = values.find(no_name);
    return entry == values.end() ? nullptr : &entry->second;
  }

  /// The axes of a group, unless it is given by its name what has none.
  const std::vector<double> *find_axes(const GroupTables &tables, const int number) const
  {
    if (const std::vector<double> *its = named(tables.orthotropic, number))
      return its;
    return named(tables.young, number) || named(tables.poisson, number)
             ? nullptr
             : find(tables.orthotropic, number);
  }

  const std::set<int> present;
  const bool has_names;         ///< in the file
  std::set<std::string> called; ///< the names and the numbers of those that are present

private:
  std::map<int, std::string> names;
};

/// Values of a set that holds all triangles are those of all groups.
void take_for_all(const std::string &file, const CellMeshFile &mesh_file,
                  const GroupsOfMesh &groups, GroupTables &tables, Faults &faults)
{
  for (const auto &[name, number] : mesh_file.number_of_name)
  {
    if (number != 0 || groups.present.count(0) != 0)
      continue;
    for (const auto &[key, values] : {std::pair("Young's modulus", &tables.young),
                                      {"Poisson's ratio", &tables.poisson},
                                      {"Thickness", &tables.thickness},
                                      {"Density", &tables.density},
                                      {"Orthotropic", &tables.orthotropic}})
      if (auto entry = values->extract(name))
      {
        entry.key() = no_name;
        if (!values->insert(std::move(entry)).inserted)
          faults.push_back(file + ": key `" + key +
                           "`: all groups are given a value twice, once by `" + name +
                           "`, a set of all triangles; expected one of both");
      }
  }
}

/// Groups that keys name and no triangle has.
void check_names(const std::string &file, const GroupTables &tables, const GroupsOfMesh &groups,
                 Faults &faults)
{
  constexpr std::size_t most = 10; // a list is there to be read
  std::string expected;
  std::vector<std::string> names;
  for (const int number : groups.present)
  {
    if (groups.name_of(number) == std::to_string(number) && !groups.goes_by_number(number))
      faults.push_back(file + ": group " + std::to_string(number) +
                       " of the mesh has no name of its own, and another group is called `" +
                       std::to_string(number) + "`; expected a name for each of them");
    names.push_back(groups.name_of(number));
    if (names.size() <= most)
      expected += (expected.empty() ? "`" : ", `") + names.back() + "`";
  }
  if (names.size() > most)
    expected += " and " + std::to_string(names.size() - most) + " more";
  const std::vector<std::pair<const char *, const GroupValues *>> of_key = {
    {"Young's modulus", &tables.young},   {"Poisson's ratio", &tables.poisson},
    {"Thickness", &tables.thickness},     {"Density", &tables.density},
    {"Orthotropic", &tables.orthotropic}, {"Layers", &tables.layers}};
  for (const auto &[key, values] : of_key)
    for (const auto &entry : *values)
    {
      if (entry.first != no_name && groups.called.count(entry.first) == 0)
        faults.push_back(file + ": key `" + key + "` names the group `" + entry.first +
                         "`, which no triangle of the mesh has; expected one of " + expected +
                         did_you_mean(entry.first, names));
    }
  for (const auto &[key, values] : of_key)
    for (const int number : groups.present)
      if (const std::string &name = groups.name_of(number);
          name != std::to_string(number) && groups.goes_by_number(number) &&
          values->count(name) != 0 && values->count(std::to_string(number)) != 0)
        faults.push_back(file + ": key `" + key + "`: group `" + name + "` is given by its name " +
                         "and by its number, " + std::to_string(number) + "; expected one of both");
}

/// The phase of a group.
Phase phase_of_group(const std::string &file, const GroupTables &tables, const GroupsOfMesh &groups,
                     const int number, Faults &faults)
{
  Phase phase;
  const std::string name = groups.name_of(number);
  bool complete          = true;
  const auto take        = [&](const char *key, const GroupValues &values)
  {
    if (const auto *entry = groups.find(values, number))
      return (*entry)[0];
    faults.push_back(file + ": group `" + name + "` of the mesh has no value in key `" + key +
                     "`; expected `" + name +
                     ": value` there, or first a value without a name, for all groups");
    complete = false;
    return 1.;
  };
  if (const std::vector<double> *values = groups.named(tables.layers, number))
  {
    std::vector<Layer> layers;
    for (std::size_t k = 0; k + 2 < values->size(); k += 3)
    {
      layers.push_back({(*values)[k], (*values)[k + 1], (*values)[k + 2]});
      const Layer &layer = layers.back();
      for (const std::string &fault :
           faults_of(isotropic(name + "`, layer `" + std::to_string(layers.size()), layer.E,
                               layer.nu, layer.thickness, 1.)))
      {
        faults.push_back(file + ": " + fault);
        complete = false;
      }
    }
    for (const auto &[key, other] : {std::pair("Young's modulus", &tables.young),
                                     {"Poisson's ratio", &tables.poisson},
                                     {"Thickness", &tables.thickness},
                                     {"Orthotropic", &tables.orthotropic}})
      if (groups.named(*other, number))
        faults.push_back(file + ": group `" + name + "` is given both in `Layers` and in `" + key +
                         "`; expected one of them: remove the other");
    phase         = complete ? layered(name, layers, 1.) : phase;
    phase.density = take("Density", tables.density);
    if (complete)
      for (const std::string &fault : faults_of(phase))
        faults.push_back(file + ": " + fault);
    return phase;
  }
  if (const auto *yarn = groups.find_axes(tables, number))
  {
    const std::vector<double> &values = *yarn;
    phase               = {name, values[0], values[1], values[2], values[3], values[4], 0., 0.};
    const bool is_named = groups.named(tables.orthotropic, number) != nullptr;
    const auto is_given = [&](const GroupValues &values)
    { return (is_named ? groups.named(values, number) : groups.find(values, number)) != nullptr; };
    if (is_given(tables.young) || is_given(tables.poisson))
      faults.push_back(
        file + ": group `" + name +
        "` is given both in `Orthotropic` and in `Young's modulus` or `Poisson's ratio`; "
        "expected one of them: remove the other");
  }
  else
  {
    const double E  = take("Young's modulus", tables.young),
                 nu = take("Poisson's ratio", tables.poisson);
    phase           = isotropic(name, E, nu, 0., 0.);
  }
  phase.thickness = take("Thickness", tables.thickness);
  phase.density   = take("Density", tables.density);
  if (complete)
    for (const std::string &fault : faults_of(phase))
      faults.push_back(file + ": " + fault);
  return phase;
}
} // namespace

std::vector<Phase> assign_phases(const std::string &file, const CellKeys &keys,
                                 CellMeshFile &mesh_file, Faults &faults)
{
  GroupTables tables(file, keys, faults);
  const GroupsOfMesh groups(mesh_file);
  take_for_all(file, mesh_file, groups, tables, faults);
  // Gmsh writes 0 where no physical group was given.
  if (!groups.has_names && groups.present == std::set<int>{0} && !groups.find(tables.young, 0) &&
      !groups.find(tables.orthotropic, 0) && !groups.find(tables.layers, 0))
  {
    std::string data;
    for (const std::string &name : mesh_file.other_data)
      data += (data.empty() ? "`" : ", `") + name + "`";
    faults.push_back(
      file + ": the mesh " + keys.mesh +
      (lower(std::filesystem::path(keys.mesh).extension().string()) == ".obj"
         ? " has no groups, so that no triangle has a material; expected one per material: "
           "`usemtl ground` in front of the faces of each"
       : data.empty() || std::filesystem::path(keys.mesh).extension() == ".msh"
         ? " has no physical groups, so that no triangle has a material; expected one "
           "per material: in Gmsh `Physical Surface(\"ground\", 1) = {...};`"
         : " has no groups, so that no triangle has a material: its cell data are " + data +
             "; expected cell data called `material`, `group`, `phase`, "
             "`gmsh:physical` or the like: rename those that tell the material") +
      ", or give all of it one value without a name");
    return {};
  }
  check_names(file, tables, groups, faults);
  std::vector<Phase> phases;
  std::vector<char> is_orthotropic;
  std::map<int, int> phase_of;
  for (const int number : groups.present)
  {
    phase_of[number] = static_cast<int>(phases.size());
    phases.push_back(phase_of_group(file, tables, groups, number, faults));
    is_orthotropic.push_back(groups.find_axes(tables, number) != nullptr);
  }
  for (int &number : mesh_file.mesh.material)
    number = phase_of[number];
  if (mesh_file.angle.size() > 0)
    turn_phases(file, keys.mesh, is_orthotropic, mesh_file, phases, faults);
  return phases;
}

} // namespace homespun::homogenization
