// SPDX-License-Identifier: MIT
// homespun load: an infinite cloth under prescribed stresses and strains.
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
  faults.check_names("--law", study.laws, law_of);
  faults.throw_if_any();
}
} // namespace

void LoadCommand::add(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
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
  add_list(*command, "--law", study.laws,
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
     "  homespun load dots.prm --strain 11=10%                          uniaxial, sides free\n"
     "  homespun load dots.prm --strain 11=10%,22=10%                   equibiaxial\n"
     "  homespun load dots.prm --stress 11=50,22=100                    biaxial 1:2\n"
     "  homespun load dots.prm --stress 11=50,12=0 --strain 22=0.02 --steps 40 --law biot,green\n"
     "  homespun load dots.prm --strain 22=-2%                          compression"},
    check_load_arguments);
}
} // namespace homespun::verification
