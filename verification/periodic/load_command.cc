// SPDX-License-Identifier: MIT
// homespun periodic load: an infinite cloth under prescribed stresses and strains.
#include "verification/periodic/periodic_command.h"

#include "verification/command/study_arguments.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>

namespace homespun::verification
{
namespace
{
struct LoadArguments : StudyArguments<LoadStudyOptions>
{
  std::vector<std::string> stresses, strains;
  int axis = 0; ///< 0: that of the pull
};

void check_load_arguments(LoadArguments &arguments)
{
  LoadStudyOptions &study = arguments.study;
  ArgumentFaults faults;
  try
  {
    study.control = load_control(arguments.stresses, arguments.strains, arguments.axis);
  }
  catch (const meshes::BadInput &bad)
  {
    for (const std::string &fault : bad.faults())
      faults.add(fault);
  }
  faults.check_names("--references", study.laws, law_of);
  faults.throw_if_any();
}
} // namespace

CLI::App &periodic(CommandLine &line)
{
  const auto is_it = [](const CLI::App *one) { return one->get_name() == "periodic"; };
  for (CLI::App *there : line.app.get_subcommands(is_it))
    return *there;
  CLI::App *command = line.app.add_subcommand(
    "periodic", "An infinite cloth: under given stresses and strains, and where its cells buckle");
  command->require_subcommand(1);
  return *command;
}

void LoadCommand::add(CommandLine &line)
{
  CLI::App *command = periodic(line).add_subcommand(
    "load", "An infinite cloth under given stresses and strains: its curve (load.csv)");
  const auto arguments    = std::make_shared<LoadArguments>();
  LoadStudyOptions &study = arguments->study;
  command->add_option("CELL.prm", study.cell_files, "Cell files")->required();
  add_list(*command, "--stress", arguments->stresses,
           "Nominal stresses by component, N per metre of rest width: 11=50,12=0");
  add_list(*command, "--strain", arguments->strains,
           "Strains by component, as fractions or percentages, also negative: 22=0.02 or 22=2%");
  command
    ->add_option(
      "--axis", arguments->axis,
      "Material axis that keeps its direction, 1 or 2 (default that of the pull: 2 where "
      "22 alone is given, else 1)")
    ->check(CLI::Range(1, 2));
  command->add_option("--steps", study.n_steps, "Even steps from rest")
    ->check(CLI::Range(1, 10000))
    ->capture_default_str();
  add_list(*command, "--references", study.laws,
           "Laws of the phases, linear, biot, green or yarn (default: yarn where biot loses a "
           "phase of the "
           "cell before 20 %, else biot); linear is always there");
  add_list(*command, "--measured", study.measured,
           "CSV files, comma-separated, with curves to draw on the same axes: columns strain_11, "
           "stress_11_N_per_m and so on");
  add_study<LoadCommand>(
    line, *command, arguments,
    {"out/NAME/load",
     "A component is given once, its stress or its strain; one that is not given is free of "
     "stress.\n"
     "Examples:\n"
     "  homespun periodic load dots.prm --strain 11=10%                          uniaxial, sides "
     "free\n"
     "  homespun periodic load dots.prm --strain 11=10%,22=10%                   equibiaxial\n"
     "  homespun periodic load dots.prm --stress 11=50,22=100                    biaxial 1:2\n"
     "  homespun periodic load dots.prm --stress 11=50,12=0 --strain 22=0.02 --steps 40 "
     "--references biot,green\n"
     "  homespun periodic load dots.prm --strain 22=-2%                          compression"},
    check_load_arguments);
}
} // namespace homespun::verification
