// SPDX-License-Identifier: MIT
// homespun cells: the shipped cells, and variants of them.
#include "verification/program/program_commands.h"

#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/errors.h"
#include "verification/command/data_folder.h"
#include "verification/command/study_arguments.h"
#include "verification/program/cells_make.h"
#include "verification/program/check_command.h"
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
    // With its drawing: without one, a cell has the mesh of another, and cannot be varied.
    if (entry.path().extension() == ".prm" &&
        exists(std::filesystem::path(entry.path()).replace_extension(".geo")))
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
            for (const std::string &setting : variant.settings)
              if (setting.rfind("yarn_width", 0) == 0)
                std::cout << "Its materials are still those of the shipped width of a yarn: "
                          << file << " says what gives those of this one.\n";
            // One rank alone: the others do not know the file's name.
            if (homogenization::has_errors(tell_findings(file).findings))
              status = exit_status::bad_input;
          });
  return status;
}
} // namespace

void CellsCommand::add(CommandLine &line)
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
