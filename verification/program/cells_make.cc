// SPDX-License-Identifier: MIT
#include "verification/program/cells_make.h"

#include "homogenization/cell/parameter_text.h"
#include "homogenization/cell/unit_cell.h"
#include "homogenization/lint/cell_reading.h"
#include "meshes/files/child_process.h"
#include "meshes/files/temporary_folder.h"
#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"
#include "verification/command/data_folder.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <regex>
#include <set>
#include <sstream>

namespace homespun::verification
{
namespace fs = std::filesystem;
using homogenization::Faults;
using homogenization::trimmed;

namespace
{
std::string content_of(const std::string &path)
{
  std::ifstream input(path, std::ios::binary);
  std::ostringstream text;
  text << input.rdbuf();
  if (!input)
    throw meshes::BadInput(path + ": cannot be read; expected a file of a shipped cell");
  return text.str();
}

/// As many digits as a decimal number keeps, and no more.
std::string number_text(const double value)
{
  std::ostringstream text;
  text << std::setprecision(15) << value;
  return text.str();
}

std::string names_of_cells()
{
  std::set<std::string> names;
  for (const auto &entry : fs::directory_iterator(cells_folder()))
    if (entry.path().extension() == ".geo")
      names.insert(entry.path().stem().string());
  std::string text;
  for (const std::string &name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// `key=value` of a known parameter, within its range.
struct Setting
{
  CellParameter parameter;
  double value;
};

std::vector<Setting> settings_of(const CellVariant &variant,
                                 const std::vector<CellParameter> &parameters, Faults &faults)
{
  std::vector<Setting> settings;
  std::set<std::string> seen;
  for (const std::string &text : variant.settings)
  {
    const std::size_t equals = text.find('=');
    const std::string key    = trimmed(text.substr(0, equals));
    const auto refuse        = [&](const std::string &expected)
    { faults.push_back("--set: found `" + text + "`; expected " + expected); };
    if (equals == std::string::npos || key.empty())
    {
      refuse("`key=value`");
      continue;
    }
    if (!seen.insert(key).second)
    {
      refuse("each parameter once");
      continue;
    }
    const CellParameter *known = nullptr;
    for (const CellParameter &parameter : parameters)
      if (parameter.name == key)
        known = &parameter;
    if (!known)
    {
      std::string list;
      for (const CellParameter &parameter : parameters)
        list += (list.empty() ? "" : ", ") + description(parameter);
      refuse("a parameter of `" + variant.cell + "`: " + list);
      continue;
    }
    const auto value = homogenization::numbers(text.substr(equals + 1));
    // Written so that a NaN is out of range.
    const bool fits = value && value->size() == 1 && (*value)[0] >= known->least &&
                      (*value)[0] <= known->most &&
                      (!known->whole || (*value)[0] == std::floor((*value)[0]));
    if (!fits)
      refuse(std::string(known->whole ? "a whole number" : "a number") + " from " +
             number_text(known->least) + " to " + number_text(known->most) + " (" + known->text +
             ")");
    else
      settings.push_back({*known, (*value)[0]});
  }
  return settings;
}

/// The Gmsh source with other defaults: what is made from it again is the variant.
std::string with_defaults(std::string geo, const std::vector<Setting> &settings)
{
  for (const Setting &setting : settings)
  {
    const std::regex default_of("(\\b" + setting.parameter.name +
                                "\\s*=\\s*\\{\\s*)[^,]+(,\\s*Min\\b)");
    geo = std::regex_replace(geo, default_of, "$01" + number_text(setting.value) + "$02",
                             std::regex_constants::format_first_only);
  }
  return geo;
}

/// The cell file with the name of its mesh, and what was changed, below its story.
std::string with_mesh(const std::string &prm, const std::string &name, const CellVariant &variant,
                      const std::vector<Setting> &settings)
{
  std::string note = "# A variant of the shipped cell " + variant.cell + ", made by homespun:";
  for (const Setting &setting : settings)
    note += " " + setting.parameter.name + " = " + number_text(setting.value) + ";";
  note.back() = '.';
  for (const Setting &setting : settings)
    if (setting.parameter.name == "yarn_width" &&
        variant.cell.find("straight") == std::string::npos)
      note += "\n# Its materials are those of the shipped width: `meshes/cells/weave.py " +
              variant.cell + " --cover " + number_text(setting.value) +
              "` gives the lines of this one.";
  if (settings.empty())
    note = "# A copy of the shipped cell " + variant.cell + ", made by homespun.";
  std::istringstream input(prm);
  std::string line, text;
  while (std::getline(input, line))
  {
    if (std::regex_search(line, std::regex("^set Mesh\\s*=")))
      line = note + "\nset Mesh            = " + name + ".msh";
    text += line + "\n";
  }
  return text;
}

/// Runs Gmsh on NAME.geo of a folder, without a shell; its messages go to a file.
void run_gmsh(const std::string &folder, const std::string &name)
{
  const std::string geo = folder + "/" + name + ".geo", msh = folder + "/" + name + ".msh",
                    log = folder + "/gmsh.log";
  const int status = meshes::run_child({"gmsh", "-2", "-format", "msh41", geo, "-o", msh}, log);
  if (status == 127)
    throw meshes::BadInput("gmsh: cannot be run; expected Gmsh, which makes the mesh: install the "
                           "package gmsh (apt install gmsh)");
  if (const std::string killed = meshes::text_of_signal(status); !killed.empty())
    throw meshes::BadInput("gmsh could not make the mesh: " + killed);
  if (status != 0)
  {
    std::string said;
    std::ifstream input(log);
    for (std::string line; said.empty() && std::getline(input, line);)
      if (line.rfind("Error", 0) == 0 && line.find(':') != std::string::npos)
        said = ": " + trimmed(line.substr(line.find(':') + 1));
    if (said.empty())
      said = " (it ended with status " + std::to_string(status) + ")";
    throw meshes::BadInput("gmsh could not make the mesh" + said +
                           "; expected values that fit together: change --set");
  }
}

std::string replaced(std::string text, const std::string &before, const std::string &after)
{
  for (std::size_t at = text.find(before); at != std::string::npos;
       at             = text.find(before, at + after.size()))
    text.replace(at, before.size(), after);
  return text;
}
} // namespace

std::vector<CellParameter> cell_parameters(const std::string &geo_file)
{
  const std::string text  = content_of(geo_file);
  const std::size_t begin = text.find("DefineConstant[");
  const std::size_t end   = text.find("];", begin == std::string::npos ? 0 : begin);
  std::vector<CellParameter> parameters;
  if (begin != std::string::npos && end != std::string::npos)
  {
    const std::string list = text.substr(begin, end - begin);
    const std::regex entry(R"re((\w+)\s*=\s*\{\s*([^,]+),\s*Min\s+([^,]+),\s*Max\s+([^,]+),\s*)re"
                           R"re((Step\s+1\s*,)?\s*Name\s+"Parameters/([^"]*)"\s*\})re");
    for (std::sregex_iterator found(list.begin(), list.end(), entry);
         found != std::sregex_iterator(); ++found)
      parameters.push_back({(*found)[1], std::stod((*found)[2]), std::stod((*found)[3]),
                            std::stod((*found)[4]), (*found)[5].matched, (*found)[6]});
  }
  if (parameters.empty())
    throw meshes::BadInput(geo_file +
                           ": no parameters found; expected a DefineConstant with `name = { "
                           "value, Min least, Max most, Name \"Parameters/text\" }`");
  return parameters;
}

std::string description(const CellParameter &parameter)
{
  return parameter.name + " (" + number_text(parameter.value) + "; " +
         number_text(parameter.least) + " to " + number_text(parameter.most) + ")";
}

std::string make_cell(const CellVariant &variant)
{
  const std::string source = cells_folder() + "/" + variant.cell;
  // A name, no path: what is read stays in the folder of the cells.
  if (variant.cell.empty() || variant.cell.find('/') != std::string::npos ||
      !fs::is_regular_file(source + ".geo"))
    throw meshes::BadInput("cells make: found `" + variant.cell +
                           "`; expected a shipped cell: " + names_of_cells());
  const std::string name = variant.name.empty() ? variant.cell : variant.name;
  Faults faults;
  if (!std::regex_match(name, std::regex("[A-Za-z0-9][A-Za-z0-9._-]*")))
    faults.push_back("--name: found `" + name +
                     "`; expected letters, digits, `.`, `_` and `-`, beginning with a letter or a "
                     "digit");
  const std::vector<Setting> settings =
    settings_of(variant, cell_parameters(source + ".geo"), faults);
  const std::string target = variant.output + "/" + name;
  if (faults.empty())
    for (const char *ending : {".geo", ".msh", ".prm"})
      if (fs::exists(target + ending))
        faults.push_back(target + ending +
                         ": exists already; expected a new file: remove it, or choose another "
                         "--name or --output");
  if (!faults.empty())
    throw meshes::BadInput(faults);

  fs::create_directories(variant.output);
  const meshes::TemporaryFolder passing(variant.output);
  const std::string trial = passing.path + "/" + name;
  const std::string geo   = with_defaults(content_of(source + ".geo"), settings);
  const std::string prm   = with_mesh(content_of(source + ".prm"), name, variant, settings);
  meshes::write_whole(trial + ".geo", geo);
  meshes::write_whole(trial + ".prm", prm);
  run_gmsh(passing.path, name);
  try
  {
    homogenization::read_unit_cell(trial + ".prm");
  }
  catch (const meshes::BadInput &bad)
  {
    for (const std::string &fault : bad.faults())
      faults.push_back(replaced(fault, passing.path, variant.output));
    faults.emplace_back("the cell that Gmsh made is not sound, nothing is written; expected values "
                        "of --set that leave every part its room");
    throw meshes::BadInput(faults);
  }
  // The .prm last: where it is, the others are.
  meshes::write_whole(target + ".geo", geo);
  meshes::write_whole(target + ".msh", content_of(trial + ".msh"));
  meshes::write_whole(target + ".prm", prm);
  return target + ".prm";
}
} // namespace homespun::verification
