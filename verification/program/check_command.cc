// SPDX-License-Identifier: MIT
// homespun check: all findings of the linter, as text, as check.json and as a picture of each cell.
#include "verification/program/check_command.h"

#include "homogenization/cell/cell_keys.h"
#include "meshes/files/hdf5_writer.h"
#include "meshes/plain/errors.h"
#include "verification/cell/rolled_sheet.h"
#include "verification/command/command.h"
#include "verification/command/report_script.h"
#include "verification/ellipticity/default_law.h"
#include "verification/program/program_commands.h"
#include "verification/record/json_files.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>

namespace homespun::verification
{
using homogenization::CellReading;
using homogenization::Finding;
using homogenization::Severity;
using homogenization::UnitCell;

namespace
{
struct CheckArguments
{
  std::vector<std::string> files;
  std::string output;
};

int number_of(const std::vector<Finding> &findings, const Severity severity)
{
  int n = 0;
  for (const Finding &finding : findings)
    n += finding.severity == severity ? 1 : 0;
  return n;
}

/// Size, lattice, phases and holes of a sound cell.
void describe(const UnitCell &cell, const int n_warnings)
{
  const double side           = std::sqrt(cell.lattice.area());
  const Eigen::VectorXd areas = homogenization::drawn_areas(cell.mesh, cell.curved_sides);
  std::cout << cell.file << ": sound";
  if (n_warnings > 0)
    std::cout << ", with " << n_warnings << (n_warnings == 1 ? " warning" : " warnings");
  std::cout << ". " << cell.mesh.n_triangles() << " triangles, " << cell.mesh.n_vertices()
            << " vertices, cell of " << side * 100. << " cm (|Y| = " << cell.lattice.area()
            << " m^2), lattice (" << cell.lattice.vectors.row(0) << ") and ("
            << cell.lattice.vectors.row(1) << ") m, " << cell.areal_density(areas) << " kg/m^2"
            << (cell.curved_sides.empty() ? "\n" : " between curved sides\n");
  const std::vector<int> group_of_phase = cell.group_of_phase(),
                         phase_of_group = cell.phase_of_group();
  std::vector<double> area(phase_of_group.size(), 0.);
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    area[static_cast<std::size_t>(
      group_of_phase[static_cast<std::size_t>(cell.mesh.material(t))])] += areas(t);
  for (std::size_t g = 0; g < phase_of_group.size(); ++g)
  {
    const homogenization::Phase &phase = cell.phases[static_cast<std::size_t>(phase_of_group[g])];
    std::cout << "  " << phase.name << ": " << 100. * area[g] / cell.lattice.area()
              << " % of the area, E " << phase.E1;
    if (phase.E2 != phase.E1)
      std::cout << " and " << phase.E2;
    std::cout << " Pa, nu " << phase.nu12 << ", thickness " << phase.thickness << " m";
    if (phase.plate)
      std::cout << " in layers, bending as E " << phase.plate->E << " Pa, nu " << phase.plate->nu
                << " about " << phase.plate->neutral << " m";
    const auto n_angles =
      std::count(group_of_phase.begin(), group_of_phase.end(), static_cast<int>(g));
    if (n_angles > 1)
      std::cout << ", in " << n_angles << " directions";
    std::cout << "\n";
  }
  const double covered = areas.sum() / cell.lattice.area();
  if (covered < 1. - 1e-9)
    std::cout << "  holes: " << 100. * (1. - covered) << " % of the area\n";
  if (cell.mesh.n_triangles() > most_triangles_rolled_at_once)
    std::cout << "  bending: of more than " << most_triangles_rolled_at_once
              << " triangles `homespun homogenize` tells from which radius on D^H holds\n";
}

/// Phases that stop being elliptic under the corotational law, pulled along one of their yarns.
void add_ellipticity_findings(CellReading &reading)
{
  for (const int p : reading.cell.phase_of_group())
  {
    const PhaseLoss loss = loss_of_biot(reading.cell.phases[static_cast<std::size_t>(p)]);
    if (loss.strain >= largest_strain_of_cloth)
      continue;
    reading.findings.push_back(
      {Severity::warning,
       "ellipticity",
       reading.cell.file + ": phase `" + loss.phase + "` pulled along " + axis_text(loss) +
         " is not elliptic under the law biot from a strain of " + percent_text(loss.strain) +
         " on, E being " + short_text(loss.ratio) + " times G there",
       "beyond it no minimum of the energy need exist: studies have the law yarn unless another "
       "is asked for, which pulling does not take there",
       {}});
  }
}

nlohmann::json json_of(const Finding &finding, const double metres_per_unit)
{
  nlohmann::json json = {{"severity", finding.severity == Severity::error ? "error" : "warning"},
                         {"kind", finding.kind},
                         {"what", finding.what},
                         {"remedy", finding.remedy},
                         {"point", nullptr},
                         {"triangle", nullptr},
                         {"vertex", nullptr}};
  if (finding.place.is_known())
    json["point"] = {finding.place.point(0) / metres_per_unit,
                     finding.place.point(1) / metres_per_unit};
  if (finding.place.triangle >= 0)
    json["triangle"] = finding.place.triangle;
  if (finding.place.vertex >= 0)
    json["vertex"] = finding.place.vertex;
  return json;
}

/// What the picture is drawn from: the mesh in its own unit, as far as it was read.
void write_mesh(const CellReading &reading, const std::string &path)
{
  const meshes::TriangleMesh &mesh = reading.cell.mesh;
  const meshes::Points vertices    = mesh.vertices / reading.metres_per_unit;
  meshes::Hdf5Writer writer(path);
  const auto n = static_cast<unsigned long long>(mesh.n_vertices()),
             m = static_cast<unsigned long long>(mesh.n_triangles());
  writer.write("vertices", {n, 2}, vertices.data(), "mesh units");
  writer.write("triangles", {m, 3}, mesh.triangles.data());
  Eigen::VectorXi material = mesh.material;
  if (reading.has_phases)
  {
    const std::vector<int> group_of_phase = reading.cell.group_of_phase();
    for (int &its : material)
      its = group_of_phase[static_cast<std::size_t>(its)];
  }
  writer.write("material", {m}, material.data());
  writer.finish();
}

/// check.json, and the meshes that are drawn, in a folder of their own.
void write_results(const std::vector<CellReading> &readings, const std::string &output)
{
  std::filesystem::create_directories(output);
  nlohmann::json cells = nlohmann::json::array();
  std::set<std::string> names;
  for (const CellReading &reading : readings)
  {
    // Two cells of one name get a file each.
    std::string name = reading.cell.name;
    for (int k = 2; !names.insert(name).second; ++k)
      name = reading.cell.name + "-" + std::to_string(k);
    nlohmann::json cell = {{"name", name},
                           {"file", reading.cell.file},
                           {"sound", !homogenization::has_errors(reading.findings)},
                           {"metres_per_unit", reading.metres_per_unit},
                           {"mesh", nullptr},
                           {"phases", nlohmann::json::array()},
                           {"phase_stiffness", nlohmann::json::array()},
                           {"findings", nlohmann::json::array()}};
    for (const Finding &finding : reading.findings)
      cell["findings"].push_back(json_of(finding, reading.metres_per_unit));
    if (reading.has_mesh)
    {
      cell["mesh"] = name + "-mesh.h5";
      write_mesh(reading, output + "/" + name + "-mesh.h5");
    }
    if (reading.has_phases)
    {
      const std::vector<Eigen::Matrix3d> stiffness = reading.cell.stiffness_of_phase();
      for (const int phase : reading.cell.phase_of_group())
      {
        cell["phases"].push_back(reading.cell.phases[static_cast<std::size_t>(phase)].name);
        cell["phase_stiffness"].push_back(stiffness[static_cast<std::size_t>(phase)].trace());
      }
    }
    cells.push_back(cell);
  }
  write_json(output + "/check.json", {{"cells", cells}});
}

int check(const CheckArguments &arguments, AfterMpi &afterwards)
{
  if (!is_root(MPI_COMM_WORLD))
    return 0;
  std::vector<CellReading> readings;
  bool any_error = false;
  for (const std::string &file : arguments.files)
  {
    readings.push_back(tell_findings(file));
    any_error = any_error || homogenization::has_errors(readings.back().findings);
  }
  if (!arguments.output.empty())
    write_pictures(readings, arguments.output, afterwards);
  return any_error ? exit_status::bad_input : exit_status::good;
}
} // namespace

void write_pictures(const std::vector<CellReading> &readings, const std::string &folder,
                    AfterMpi &afterwards)
{
  write_results(readings, folder);
  afterwards = [folder]()
  {
    if (run_report_script("check_pictures.py", {folder}) != 0)
      throw meshes::BadInput("the pictures could not be drawn, see above; the findings are in " +
                             folder + "/check.json");
    std::cout << "Written to " << folder << ": check.json, a picture of each cell\n";
    return 0;
  };
}

CellReading tell_findings(const std::string &file)
{
  CellReading reading = homogenization::inspect_cell(file);
  if (!homogenization::has_errors(reading.findings))
  {
    add_ellipticity_findings(reading);
    for (const Finding &finding : findings_of_folds(reading.cell))
      reading.findings.push_back(finding);
    describe(reading.cell, number_of(reading.findings, Severity::warning));
  }
  std::cout << std::flush;
  for (const Finding &finding : reading.findings)
    if (finding.severity == Severity::error)
      std::cerr << "homespun: " << homogenization::text_of(finding) << "\n";
    else
      std::cout << "  warning: " << homogenization::text_of(finding) << "\n";
  return reading;
}

void CheckCommand::add(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "check", "Read and check cells at once: all errors, and what may cause trouble later");
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option("CELL.prm", arguments->files, "Cell files")->required();
  command->add_option(
    "--output", arguments->output,
    "Folder of check.json and of a picture of each cell in which the places are marked");
  command->footer(
    "Exit status: 0 sound, with warnings or without; 2 an error.\n\nKeys of a cell file:\n\n" +
    homogenization::unit_cell_keys());
  command->callback(
    [&line, arguments]()
    { line.at_once = [&line, arguments]() { return check(*arguments, line.afterwards); }; });
}
} // namespace homespun::verification
