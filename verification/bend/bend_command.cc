// SPDX-License-Identifier: MIT
// homespun bend: error of an up-sampled sheet that bends.
#include "verification/bend/bend_command.h"

#include "verification/command/study_arguments.h"
#include "verification/record/number_text.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <memory>

namespace homespun::verification
{
namespace
{
void check_bend_arguments(BendStudyOptions &study)
{
  ArgumentFaults faults;
  for (const double curvature : study.curvatures)
    if (!(curvature > 0. && curvature <= 1.))
      faults.add("--curvatures: found " + short_text(curvature) +
                 "; expected numbers above 0 and up to 1, curvature times cell side: cells of 1 cm "
                 "on a roll of radius 10 cm have 0.1");
  std::sort(study.curvatures.begin(), study.curvatures.end());
  study.curvatures.erase(std::unique(study.curvatures.begin(), study.curvatures.end()),
                         study.curvatures.end());
  for (const auto &[option, is_empty] : {std::pair("--curvatures", study.curvatures.empty()),
                                         std::pair("--loads", study.loads.empty()),
                                         std::pair("--references", study.references.empty())})
    if (is_empty)
      faults.add(std::string(option) + ": found nothing; expected at least one");
  faults.check_names("--loads", study.loads, names_of_bending_loads());
  faults.check_names("--references", study.references,
                     {bending_references.begin(), bending_references.end()});
  faults.throw_if_any();
}
} // namespace

void BendCommand::add(CommandLine &line)
{
  using Arguments   = StudyArguments<BendStudyOptions>;
  CLI::App *command = line.app.add_subcommand(
    "bend", "Error of a bent sheet, in position and normal, against its curvature (bend.csv)");
  const auto arguments    = std::make_shared<Arguments>();
  BendStudyOptions &study = arguments->study;
  command->add_option("CELL.prm", study.cell_files, "Cell files")->required();
  CLI::Option *cells = command->add_option("--cells", study.n_cells, "Cells per side of the sheet")
                         ->check(CLI::Range(1, 100))
                         ->capture_default_str();
  add_list(*command, "--loads", study.loads, "Loads, comma-separated");
  add_list(*command, "--references", study.references,
           "References, comma-separated: linear (small turns), biot (large turns; minutes)");
  add_list(*command, "--curvatures", study.curvatures,
           "Curvatures times cell side, comma-separated");
  command->add_flag("--quick", study.is_quick, "5 x 5 cells unless given otherwise: seconds");
  add_study<BendCommand>(
    line, *command, arguments,
    {"out/NAME/bend, with --quick out/NAME/bend-quick",
     "Loads: roll (clamped at axis 1's beginning, line moments at its end), cantilever-1,\n"
     "cantilever-2 (clamped where axis 1 or 2 begins, under pressure), twist (both ends of axis 1\n"
     "clamped, one turned), pressure (clamped all around).\n"
     "Methods: flat (D^H's sheet at the corners of two flat triangles per cell), affine (its "
     "curved\n"
     "surface), localized (and the deflection of the cell), affine+edges (and what clamps and "
     "free\n"
     "edges add), full (all). The reference linear is the resolved plate of the phases in linear\n"
     "theory: errors are proportional to the curvature, for small turns. biot is the resolved "
     "cloth,\n"
     "at large turns, under cantilever-1 and cantilever-2: clamps alone have a term of edges "
     "there, and\n"
     "its loads are those of the curvatures in linear theory. Curvature is that of the "
     "homogenized\n"
     "sheet, root mean square. Normals decide how cloth is lit, positions where it is.\n"
     "Example:\n  homespun bend mycell.prm --quick\n"
     "  homespun bend mycell.prm --loads cantilever-1,twist --cells 20\n"
     "  homespun bend mycell.prm --loads cantilever-2 --references linear,biot --cells 5"},
    [cells](Arguments &given)
    {
      if (given.study.is_quick && cells->count() == 0)
        make_quick(given.study);
      check_bend_arguments(given.study);
    });
}
} // namespace homespun::verification
