// SPDX-License-Identifier: MIT
// homespun homogenize, cells: what concerns a cell alone.
#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/errors.h"
#include "verification/program/cells_make.h"
#include "verification/program/check_command.h"
#include "verification/program/commands.h"
#include "verification/program/data_folder.h"
#include "verification/program/studies.h"
#include "verification/program/study_arguments.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>

namespace homespun::verification
{
namespace
{
/// The first sentence of the comment at the head of a cell file: its story in one line.
std::string story_of(const std::string &file)
{
  std::ifstream input(file);
  std::string line, story;
  while (std::getline(input, line) && line.rfind("#", 0) == 0)
    story += (story.empty() ? "" : " ") + line.substr(std::min<std::size_t>(2, line.size()));
  return story.substr(0, story.find(". "));
}

/// @param pictures folder; empty: none
int list_cells(const std::string &pictures, AfterMpi &afterwards)
{
  if (!is_root(MPI_COMM_WORLD))
    return 0;
  std::vector<std::filesystem::path> files;
  for (const auto &entry : std::filesystem::directory_iterator(cells_folder()))
    if (entry.path().extension() == ".prm")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (std::filesystem::path file : files)
  {
    std::cout << file.string() << "\n    " << story_of(file.string()) << "\n    --set";
    const char *separator = " ";
    for (const CellParameter &parameter : cell_parameters(file.replace_extension(".geo").string()))
    {
      std::cout << separator << description(parameter);
      separator = ", ";
    }
    std::cout << "\n";
  }
  if (!pictures.empty())
  {
    std::vector<homogenization::CellReading> readings;
    for (const std::filesystem::path &file : files)
      readings.push_back(homogenization::inspect_cell(file.string()));
    write_pictures(readings, pictures, afterwards);
  }
  return 0;
}

/// Makes a variant and says of it what `homespun check` says.
int make(const CellVariant &variant)
{
  int status = exit_status::good;
  on_root(MPI_COMM_WORLD,
          [&]()
          {
            const std::string file = make_cell(variant);
            std::cout << "Made " << file << ", with its .geo and .msh\n";
            // One rank alone: the others do not know the file's name.
            if (homogenization::has_errors(tell_findings(file).findings))
              status = exit_status::bad_input;
          });
  return status;
}
} // namespace

void add_homogenize_command(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "homogenize",
    "C^H and the bending stiffness D^H with their guaranteed brackets, characteristic "
    "displacements, deflections, strains and stresses of the phases, moduli: cell.h5, "
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
  using homogenization::CellSolver;
  arguments->study.solve.solver = CellSolver::fastest;
  std::map<std::string, CellSolver> solvers;
  for (const CellSolver solver : {CellSolver::fastest, CellSolver::direct, CellSolver::multigrid})
    solvers[homogenization::name_of(solver)] = solver;
  command
    ->add_option("--solver", arguments->study.solve.solver,
                 "Of the cell problems: fastest, direct, multigrid; fastest is direct up to "
                 "1,600,000 DoFs, and "
                 "direct takes over where multigrid fails")
    ->transform(CLI::CheckedTransformer(solvers).description(""))
    ->default_str(homogenization::name_of(CellSolver::fastest));
  CLI::Option *tolerance =
    command
      ->add_option(
        "--tolerance", arguments->study.bracket.tolerance,
        "Refine adaptively until the brackets C_lower <= C^H <= C_upper and D_lower <= D^H <= "
        "D_upper both have this relative width, the largest v.(C_upper - C_lower).v / v.C_upper.v; "
        "each has its own meshes; without it the brackets are those of the given mesh")
      ->check(CLI::Range(1e-12, 1.));
  CLI::Option *max_dofs =
    command
      ->add_option(
        "--max-dofs", arguments->study.bracket.max_dofs,
        "DoFs up to which brackets are made, of the larger of its two problems; adaptivity stops "
        "before")
      ->check(CLI::Range(100u, 20000000u))
      ->capture_default_str();
  CLI::Option *uncertain = command->add_option(
    "--uncertain", arguments->uncertain,
    "`phase.constant=range, ...`, such as soft.E=20%,hard.thickness=1e-5: inputs that "
    "are known to a range alone, of their value or in Pa, m, deg; constants are E, nu "
    "and thickness, or E1, E2, nu12, G12, thickness and angle of an orthotropic "
    "phase. Their largest effect on C^H and D^H, to first order, stands beside the "
    "brackets");
  command
    ->add_flag("!--no-bars", arguments->study.bars,
               "Neither brackets nor, where there are none, the finer solve of the error bar: the "
               "cell problems alone, without D^H, for large meshes")
    ->excludes(tolerance)
    ->excludes(max_dofs)
    ->excludes(uncertain);
  command
    ->add_flag("--pieces", arguments->study.pieces,
               "Also characteristic-displacements-refined.pvtu: on the mesh of the solve, a piece "
               "from each rank")
    ->excludes(tolerance);
  add_folder_options(*command, arguments->study, "out/NAME/homogenize");
  command->footer(
    "Example:\n  homespun homogenize meshes/cells/layered.prm\n"
    "  homespun homogenize meshes/cells/three-stiffness.prm --tolerance 1e-3\n"
    "  homespun homogenize meshes/cells/layered.prm --uncertain soft.E=20%,hard.E=20%\n"
    "  mpirun -n 2 homespun homogenize mycell.prm --refine 2 --pieces");
  command->callback(
    [&line, arguments]()
    { line.solve = [&line, arguments]() { return line.studies.homogenize(*arguments); }; });
}

void add_cells_command(CommandLine &line)
{
  CLI::App *command =
    line.app.add_subcommand("cells", "List the shipped cells with their parameters; make variants");
  command->require_subcommand(0, 1);
  const auto pictures = std::make_shared<std::string>();
  command->add_option("--pictures", *pictures, "Folder for a picture of each cell, .svg and .png");
  command->callback(
    [&line, command, pictures]()
    {
      if (command->get_subcommands().empty())
        line.at_once = [&line, pictures]() { return list_cells(*pictures, line.afterwards); };
    });
  command->footer("Example:\n  homespun cells\n  homespun cells --pictures out/cells\n  homespun "
                  "cells make twill --set yarn_width=0.4");

  CLI::App *make_command = command->add_subcommand(
    "make", "Copy a shipped cell, change parameters of its Gmsh source, mesh and check it");
  const auto variant = std::make_shared<CellVariant>();
  make_command->add_option("NAME", variant->cell, "A shipped cell")->required();
  make_command
    ->add_option("--set", variant->settings,
                 "`key=value`, a parameter of the cell; may be given several times")
    ->allow_extra_args(false);
  make_command->add_option("--name", variant->name, "Name of the new files (default NAME)");
  make_command->add_option("--output", variant->output, "Folder of the new files")
    ->capture_default_str();
  make_command->footer(
    "Writes NAME.geo, NAME.msh and NAME.prm, or nothing. Gmsh makes the mesh: apt "
    "install gmsh.\nExample:\n"
    "  homespun cells make twill --set yarn_width=0.4 --output mine\n"
    "  homespun cells make random-dots --set seed=7 --set dots=20 --name random-7");
  make_command->callback([&line, variant]()
                         { line.at_once = [variant]() { return make(*variant); }; });
}
} // namespace homespun::verification
