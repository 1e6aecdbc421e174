// SPDX-License-Identifier: MIT
// homespun periodic stability: where the cells start to buckle in their plane.
#include "verification/periodic/periodic_command.h"

#include "homogenization/cell/parameter_text.h"
#include "verification/command/study_arguments.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cmath>
#include <memory>
#include <optional>

namespace homespun::verification
{
namespace
{
struct StabilityArguments : StudyArguments<StabilityStudyOptions>
{
  std::string supercell;
  std::vector<std::string> strains = {"-2%", "-5%", "-10%", "-15%", "-20%"};
};

/// Reads the strains, each as a fraction or a percentage.
void read_strains(const std::vector<std::string> &texts, std::vector<double> &strains,
                  ArgumentFaults &faults)
{
  strains.clear();
  for (const std::string &text : texts)
  {
    const bool is_percentage = !text.empty() && text.back() == '%';
    const auto found =
      homogenization::numbers(text.substr(0, text.size() - (is_percentage ? 1 : 0)));
    if (!found || found->size() != 1 || !std::isfinite((*found)[0]))
    {
      faults.add("--strains: found `" + text +
                 "`; expected numbers with a decimal point, or percentages like -5%");
      continue;
    }
    const double strain = (*found)[0] / (is_percentage ? 100. : 1.);
    if (strain == 0.)
      faults.add("--strains: found 0; expected strains that are not zero: at rest the margin is 1");
    else if (!is_percentage && std::abs(strain) >= 0.5)
      faults.add("--strains: found " + text + ", which is " + short_text(100. * strain) +
                 " %; if percent was meant, write " + text + "%, and else " +
                 short_text(100. * strain) + "%");
    else if (strain <= -1.)
      faults.add("--strains: found " + text +
                 "; expected more than -100%, where nothing is left "
                 "of the cloth");
    else
      strains.push_back(strain);
  }
  if (texts.empty())
    faults.add("--strains: found nothing; expected one strain at least, like -5%");
}

void check_stability_arguments(StabilityArguments &arguments)
{
  StabilityStudyOptions &study = arguments.study;
  ArgumentFaults faults;
  read_strains(arguments.strains, study.strains, faults);
  faults.check_names("--loads", study.loads,
                     std::vector<std::string>{"periodic-11", "periodic-22", "periodic-12",
                                              "uniaxial-1", "uniaxial-2"});
  faults.check_names("--references", study.laws, law_of);
  if (const auto n = read_supercell(arguments.supercell, faults))
    study.supercell = Eigen::Vector2i((*n)[0], (*n)[1]);
  faults.throw_if_any();
}
} // namespace

void StabilityCommand::add(CommandLine &line)
{
  CLI::App *command = periodic(line).add_subcommand(
    "stability", "Where the cells start to buckle in their plane: the Bloch margin against strain "
                 "(stability.csv)");
  const auto arguments         = std::make_shared<StabilityArguments>();
  StabilityStudyOptions &study = arguments->study;
  command->add_option("CELL.prm", study.cell_files, "Cell files")->required();
  add_list(*command, "--loads", study.loads,
           "Loads of an infinite cloth: periodic-11, -22 or -12 (all strains given), uniaxial-1 or "
           "-2 (sides free)");
  add_list(*command, "--strains", arguments->strains,
           "Strains, as fractions or percentages, negative where the cloth is pressed");
  add_list(
    *command, "--references", study.laws,
    "Laws of the phases: linear, biot, green or yarn (default: yarn where biot loses a phase of "
    "the cell before 20 %, else biot)");
  command
    ->add_option("--refine", study.n_refinements,
                 "1: each path once more on the refined mesh, for the error of the given one; 0: "
                 "without")
    ->check(CLI::Range(0, 1))
    ->capture_default_str();
  command->add_option(
    "--supercell", arguments->supercell,
    "N1xN2 cells that are solved as one beyond the first loss, like 2x2 (default: "
    "those over which the lowest wave repeats)");
  add_study<StabilityCommand>(
    line, *command, arguments,
    {"out/NAME/stability",
     "beta is 1 at rest and zero where a wave of displacement costs nothing. Lost first by long\n"
     "waves: the macroscopic law localizes; by a wave k of finite length: a pattern over 1/k "
     "cells.\n"
     "Examples:\n"
     "  homespun periodic stability honeycomb.prm                                  pressed, sides "
     "free\n"
     "  homespun periodic stability layered.prm --loads periodic-11 --strains=-1%,-5%,-10%,-20%\n"
     "  homespun periodic stability mycell.prm --loads uniaxial-2 --strains 5%,10%,20% "
     "--references biot,green"},
    check_stability_arguments);
}
} // namespace homespun::verification
