// SPDX-License-Identifier: MIT
// homespun homogenize, cells: what concerns a cell alone.
#include "meshes/errors.h"
#include "verification/build_info.h"
#include "verification/cell_study.h"
#include "verification/commands.h"
#include "verification/on_root.h"
#include "verification/progress.h"

#include <deal.II/base/mpi.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
struct HomogenizeArguments
{
  std::string file;
  CellStudyOptions study;
};

int homogenize(HomogenizeArguments arguments)
{
  const UnitCell cell     = homogenization::read_unit_cell(arguments.file);
  CellStudyOptions &study = arguments.study;
  if (study.output.empty())
    study.output = "out/" + cell.name;
  const AssessedCell assessed = run_cell_study(cell, study, MPI_COMM_WORLD);
  if (is_root(MPI_COMM_WORLD) && !study.quiet)
    std::cout << summary(cell, assessed) << "Written to " << study.output
              << ": homogenize.json, cell.h5, cell.json, characteristic-displacements.vtu\n";
  return any_failed(assessed.checks) ? 1 : 0;
}

/// The comment lines at the head of a cell file: its story.
std::string story_of(const std::string &file)
{
  std::ifstream input(file);
  std::string line, story;
  while (std::getline(input, line) && line.rfind("#", 0) == 0)
    story += "    " + line.substr(std::min<std::size_t>(2, line.size())) + "\n";
  return story;
}

int list_cells()
{
  if (!is_root(MPI_COMM_WORLD))
    return 0;
  std::vector<std::string> files;
  for (const auto &entry : std::filesystem::directory_iterator(cells_folder()))
    if (entry.path().extension() == ".prm")
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string &file : files)
    std::cout << file << "\n" << story_of(file);
  return 0;
}
} // namespace

std::string cells_folder()
{
  const std::string in_sources = std::string(HOMESPUN_SOURCE_DIR) + "/meshes/cells";
  return std::filesystem::is_directory(in_sources) ? in_sources
                                                   : std::string(HOMESPUN_DATA_DIR) + "/cells";
}

void add_homogenize_command(CLI::App &app, Action &action)
{
  CLI::App *command = app.add_subcommand(
    "homogenize", "C^H with its guaranteed bracket, characteristic displacements, moduli: cell.h5, "
                  "homogenize.json, a .vtu for ParaView");
  const auto arguments = std::make_shared<HomogenizeArguments>();
  command->add_option("CELL.prm", arguments->file, "Cell file")->required();
  command
    ->add_option("--order", arguments->study.solve.order,
                 "Order of the elements, 1 (solves on the mesh as given) or 2")
    ->check(CLI::Range(1, 2))
    ->capture_default_str();
  command
    ->add_option("--refine", arguments->study.solve.refine,
                 "Uniform refinements of the mesh; each makes four triangles of one")
    ->check(CLI::Range(0, 8))
    ->capture_default_str();
  command
    ->add_option(
      "--tolerance", arguments->study.bracket.tolerance,
      "Refine adaptively until the bracket C_lower <= C^H <= C_upper has this relative "
      "width, the largest v.(C_upper - C_lower).v / v.C_upper.v; without it the bracket is "
      "that of the given mesh")
    ->check(CLI::Range(1e-12, 1.));
  command
    ->add_option(
      "--max-dofs", arguments->study.bracket.max_dofs,
      "DoFs up to which a bracket is made, of the larger of its two problems; adaptivity "
      "stops before")
    ->check(CLI::Range(100u, 20000000u))
    ->capture_default_str();
  command->add_option("--output", arguments->study.output,
                      "Folder of the results (default out/NAME)");
  command->add_flag("--quiet", arguments->study.quiet, "Print nothing but faults");
  command->footer("Example:\n  homespun homogenize meshes/cells/layered.prm\n"
                  "  homespun homogenize meshes/cells/three-stiffness.prm --tolerance 1e-3\n"
                  "  mpirun -n 2 homespun homogenize mycell.prm --refine 2");
  command->callback([&action, arguments]()
                    { action = [arguments]() { return homogenize(*arguments); }; });
}

void add_cells_command(CLI::App &app, Action &action)
{
  CLI::App *command = app.add_subcommand("cells", "List the shipped cells");
  command->callback([&action]() { action = list_cells; });
}
} // namespace homespun::verification
