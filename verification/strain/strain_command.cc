// SPDX-License-Identifier: MIT
// homespun strain: error against strain and its page.
#include "verification/strain/strain_command.h"

#include "homogenization/cell/parameter_text.h"
#include "verification/command/study_arguments.h"
#include "verification/method/method.h"
#include "verification/record/fields.h"
#include "verification/record/number_text.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <memory>

namespace homespun::verification
{
namespace
{
struct StrainArguments : StudyArguments<StrainStudyOptions>
{
  std::string supercell;
};

/// A strain as a fraction: `10%` is 0.1. A plain number from 0.5 on is asked about, because whoever
/// thinks in percent writes 1 for 1 %.
std::string fraction_of(const std::string &text)
{
  const auto value = [&](const std::size_t length) -> double
  {
    const auto found = homogenization::numbers(text.substr(0, length));
    return found && found->size() == 1 ? (*found)[0] : std::nan("");
  };
  if (!text.empty() && text.back() == '%' && std::isfinite(value(text.size() - 1)))
  {
    char fraction[32];
    std::snprintf(fraction, sizeof(fraction), "%.17g", value(text.size() - 1) / 100.);
    return fraction;
  }
  // Commas part the list: of 0,01 this is the second entry.
  if (text.size() > 1 && text[0] == '0' && std::isdigit(static_cast<unsigned char>(text[1])))
    throw CLI::ValidationError("found `" + text +
                               "` behind a comma; numbers have a decimal point: 0." + text);
  if (const double strain = value(text.size()); strain >= 0.5)
    throw CLI::ValidationError("found " + text + ", which is " + short_text(100. * strain) +
                               " %; if percent was meant, write " + text + "%, and else " +
                               short_text(100. * strain) + "%");
  return text;
}

bool is_periodic_name(const std::string &load)
{
  return load.rfind("periodic", 0) == 0 || load.rfind("uniaxial", 0) == 0;
}

/// Ascending strains; the references walk up the ladder.
void check_strain_arguments(StrainStudyOptions &study, const std::string &supercell)
{
  ArgumentFaults faults;
  for (const double strain : study.strains)
    if (!(strain > 0. && strain <= 1.))
      faults.add("--strains: found " + short_text(strain) +
                 "; expected fractions between 0 and 1 with a decimal point, 0.1 or 10% for 10 %");
  std::sort(study.strains.begin(), study.strains.end());
  study.strains.erase(std::unique(study.strains.begin(), study.strains.end()), study.strains.end());
  for (std::size_t k = 1; study.keep && k < study.strains.size(); ++k)
    if (const std::string text = short_text(study.strains[k]);
        text == short_text(study.strains[k - 1]))
      faults.add("--strains: found " + to_field(study.strains[k - 1]) + " and " +
                 to_field(study.strains[k]) + ", which are both " + text +
                 " in the names of files that --keep leaves; expected strains that differ in six "
                 "digits");
  for (const auto &[option, is_empty] :
       {std::pair("--strains", study.strains.empty()), std::pair("--loads", study.loads.empty()),
        std::pair("--methods", study.methods.empty())})
    if (is_empty)
      faults.add(std::string(option) + ": found nothing; expected at least one");
  faults.check_names("--loads", study.loads, [](const std::string &name) { return Load(name); });
  faults.check_names("--references", study.references, law_of);
  faults.read_methods(study, study.methods, {Term::curved}); // sheets lie in a plane
  if (const auto n = read_supercell(supercell, faults))
    study.supercell = *n;
  if (has_supercell(study) &&
      std::none_of(study.loads.begin(), study.loads.end(), is_periodic_name))
    faults.add("--supercell: found it beside no periodic load; expected one among --loads, like "
               "uniaxial-1: sheets have --cells");
  faults.throw_if_any();
}
} // namespace

void StrainCommand::add(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "strain", "Error against strain (Figure 3): up-sampled cloth compared with the resolved one");
  const auto arguments      = std::make_shared<StrainArguments>();
  StrainStudyOptions &study = arguments->study;
  study                     = default_strain_study();

  command->add_option("CELL.prm", study.cell_files, "Cell files")->required();
  CLI::Option *cells =
    command->add_option("--cells", study.n_cells, "Cells per side of the sheet; the paper has 20")
      ->check(CLI::Range(1, 200))
      ->capture_default_str();
  command->add_option("--supercell", arguments->supercell,
                      "N1xN2 cells that repeat under periodic loads, like 2x2 (default: one cell)");
  CLI::Option *strains = add_list(*command, "--strains", study.strains,
                                  "Strains as fractions or percentages, 0.1 or 10%, "
                                  "comma-separated")
                           ->transform(fraction_of);
  add_list(*command, "--loads", study.loads, "Loads, comma-separated");
  add_list(*command, "--references", study.references,
           "Laws of the fine reference (default linear, yarn or biot by the cell, green)");
  add_list(*command, "--methods", study.methods,
           "Methods of up-sampling, comma-separated: a preset, with terms added or removed");
  command->add_flag("--quick", study.is_quick,
                    "4 x 4 cells at 0.1, 1 and 10 % unless given otherwise: seconds");
  command->add_flag("!--no-budget", study.budget,
                    "Leave out the error budget: budget.csv, the error split into its parts");
  command->add_flag("!--no-runtime", study.run_time,
                    "Leave out error against run time: runtime.csv, every method");
  command->add_flag("--keep", study.keep,
                    "Keep meshes and positions of every level in CELL/positions/, for a method of "
                    "your own: see `homespun judge`");
  add_study<StrainCommand>(
    line, *command, arguments,
    {"out/NAME/strain, with --quick out/NAME/strain-quick",

     "Loads: periodic-11, periodic-22, periodic-12 (infinite cloth; 12 is simple shear), strip-1,\n"
     "strip-2 (two edges clamped, one pulled outwards), shear-frame (upper edge moved sideways);\n"
     "where asked for: uniaxial-1, uniaxial-2 (infinite cloth, pulled, its sides free), "
     "periodic-all\n"
     "(11, half of it 22, and 12 at once).\n"
     "Methods: affine (the coarse motion, interpolated), localized (the paper's), full (all terms\n"
     "that have a meaning under the law and load). Terms: p2 (coarse triangles of six nodes), "
     "edges\n"
     "(slip, tension and layers of the sheet's edges), cubic (energy of the coarse cloth), modes\n"
     "(beside chi; quadratic, or under yarn fitted over the strains of the study), micro (chi and "
     "what\n"
     "goes with it); and of cloths that bend, in `drape` and `upsample`, curved. Like "
     "localized+p2,\n"
     "full-cubic-modes, full-micro. The gain of up-sampling\n"
     "itself is measured against the coarse cloth of full: include full-micro and affine+p2.\n"
     "Of each level: errors (strain.csv), forces of the clamps or the stress (forces.csv); of\n"
     "sheets, at the largest strain and near 10 %, displacements for ParaView\n"
     "(CELL/sheet-LOAD-STRAIN.vtu).\n"
     "References: linear; biot (that of the corotational coarse cloth); yarn (stretch and angle "
     "of\n"
     "two yarns, for cells with orthotropic phases; the coarse cloth takes it, too); green\n"
     "(St. Venant-Kirchhoff). By default, a cell has yarn instead of biot if one of\n"
     "its phases, pulled along a yarn, has no minimum under biot before 20 % (4/(E/G - 4)).\n"
     "Example:\n  homespun strain mycell.prm --quick\n"
     "  mpirun -n 2 homespun strain mycell.prm --loads strip-2,shear-frame --strains 0.01,0.1"},
    [cells, strains](StrainArguments &given)
    {
      if (given.study.is_quick)
      {
        const StrainStudyOptions asked = given.study;
        make_quick(given.study);
        if (cells->count() > 0)
          given.study.n_cells = asked.n_cells;
        if (strains->count() > 0)
          given.study.strains = asked.strains;
      }
      check_strain_arguments(given.study, given.supercell);
    });
}
} // namespace homespun::verification
