// SPDX-License-Identifier: MIT
#include "verification/strain/study_description.h"

#include "verification/cell/study_inputs.h"
#include "verification/law/laws.h"
#include "verification/method/method.h"
#include "verification/record/provenance.h"
#include "verification/reference/loads.h"
#include "verification/strain/cell_references.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace homespun::verification
{
namespace
{
bool has_periodic(const StrainStudyOptions &options)
{
  return std::any_of(options.loads.begin(), options.loads.end(),
                     [](const std::string &load) { return Load(load).is_periodic(); });
}

bool has(const std::vector<std::string> &names, const char *name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The methods that are no others than those before them, as in `a, b`; none where no load of the
/// kind is asked for.
std::string same_as_others(const StrainStudyOptions &options, const std::string &law,
                           const LoadKind kind)
{
  const bool is_sheet = kind == LoadKind::sheet;
  if (is_sheet ? !has_sheet(options) : !has_periodic(options))
    return {};
  const std::vector<std::string> distinct =
    distinct_methods(options.methods, law_of(law), Load(Load::names_of(kind).front()));
  std::string text;
  for (const std::string &name : options.methods)
    if (!has(distinct, name.c_str()))
      text += (text.empty() ? "" : ", ") + name;
  return text;
}

nlohmann::ordered_json what_was_left_out(const StrainStudyOptions &options)
{
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  const auto left_out        = [&](const std::string &what, const std::string &why) {
    all.push_back({{"what", what}, {"why", why}});
  };
  left_out("mass, damping, time integration", "the loads are static");
  left_out("third displacement component, bending, rotation out of the plane",
           "the loads act in the plane: coarse cloth and reference carry two components");
  left_out("contact", "no load has an obstacle");
  left_out("per-vertex coarse index of the up-sampling",
           "the coarse mesh is aligned with the lattice: all cells share one table");
  if (has_periodic(options) && !has_supercell(options))
    left_out("resolved sheet of the periodic loads",
             "an infinite cloth repeats one cell: one cell with periodic constraints is exact");
  for (const std::string &name : options.methods)
  {
    const Method method(name);
    for (const std::string &law : options.references)
      if (const std::string less = method.beyond(method.under(law_of(law))); !less.empty())
        left_out(less + " of the method " + name + " against the reference " + law,
                 law == "linear" ? "linear theory has neither a cubic energy nor modes beside chi"
                                 : "under laws of yarns a cell has no cubic energy");
    const Method of_sheet = method.under(Law::linear).without(Term::curved);
    if (const std::string less = of_sheet.beyond(under(of_sheet, Law::linear, Load("periodic-11")));
        has_periodic(options) && !less.empty())
      left_out(less + " of the method " + name + " under periodic loads",
               "an infinite cloth has no edges, and the motion of its coarse cloth is given");
  }
  for (const LoadKind kind : {LoadKind::periodic, LoadKind::sheet})
    for (const std::string &law : options.references)
      if (const std::string same = same_as_others(options, law, kind); !same.empty())
        left_out(
          same + (kind == LoadKind::sheet ? " on sheets" : " under periodic loads") +
            ", against the reference " + law,
          "with the terms that count there it is the same as another method, which has rows");
  for (const std::string &load : Load::names())
    if (!has(options.loads, load.c_str()))
      left_out("load " + load, "--loads does not name it");
  if (options.budget &&
      std::any_of(options.loads.begin(), options.loads.end(),
                  [](const std::string &load) { return Load(load).has_free_sides(); }))
    left_out("error budget of uniaxial loads", "its parts are those of given macro strains");
  if (options.budget && has_periodic(options) && has_supercell(options))
    left_out("error budget of periodic loads", "its parts are those of one cell: --supercell");
  if (!options.budget)
    left_out("error budget", "--no-budget");
  if (!options.run_time)
    left_out("error against run time", "--no-runtime");
  else if (!has_run_times(options))
    left_out("error against run time",
             "it is measured on a sheet, against biot or the law of its yarns");
  return all;
}

/// Of the levels that were reached.
std::string note_of_fluctuation(const std::vector<LevelRow> &steps)
{
  double largest_change = 0., seconds = 0., seconds_fine = 0.;
  for (const LevelRow &step : steps)
    if (step.fluctuation > 0. && !Load(step.load).is_periodic())
    {
      largest_change = std::max(largest_change, step.fluctuation_bar / step.fluctuation);
      seconds += step.seconds_homogenized;
      seconds_fine += step.seconds_fine;
    }
  if (seconds == 0.)
    return {};
  char text[400];
  std::snprintf(
    text, sizeof(text),
    "Fluctuation: reference minus the homogenized sheet (C^H in every triangle, quads a quarter "
    "of a cell wide; the law of the reference, but biot beside green, and beside yarn where C^H "
    "has "
    "no axes of yarns). Its mean "
    "changes by at most %.2g %% from a homogenized sheet half as fine; these sheets took %.3g s, "
    "the references %.3g s.",
    100. * largest_change, seconds, seconds_fine);
  return text;
}

std::vector<std::string> notes_on_the_method(const StrainStudyOptions &options,
                                             const StudyRecord &record)
{
  std::vector<std::string> notes = {
    "The cell is homogenized with P1 on its given mesh, the discretization of the reference: "
    "errors are those of the method on this mesh, which both sides share; the error bar says how "
    "far P1 is from the limit of fine meshes.",
    "Errors are computed from positions in double precision; the times beside them are of one run "
    "of the coarse solve and of up-sampling, in double precision on one thread."};
  if (const std::string note = note_of_fluctuation(record.steps); !note.empty())
    notes.push_back(note);
  if (has_periodic(options) && has_supercell(options))
    notes.push_back("Under periodic loads " + std::to_string(options.supercell[0]) + " x " +
                    std::to_string(options.supercell[1]) +
                    " cells repeat; a state of one cell that is not stable there is left along its "
                    "mode. The error bar is that of one cell.");
  double smallest_bar = 1., largest_bar = 0.;
  for (const StrainRow &row : record.rows)
    if (row.method == "localized" && Load(row.load).is_periodic() && row.mean > 0. &&
        row.uncertainty > row.mean)
    {
      smallest_bar = std::min(smallest_bar, row.mean / row.uncertainty);
      largest_bar  = std::max(largest_bar, row.uncertainty / row.mean);
    }
  if (largest_bar > 1.)
  {
    char text[300];
    std::snprintf(
      text, sizeof(text),
      "In the infinite cloth the localized error lies below the reference's error bar at some "
      "levels, down to %.2g of it: there it says that method and reference agree on this mesh, "
      "and nothing of the limit of fine meshes.",
      smallest_bar);
    notes.emplace_back(text);
  }
  if (std::any_of(record.rows.begin(), record.rows.end(),
                  [](const StrainRow &row) { return std::isfinite(row.uncertainty); }))
    notes.emplace_back(
      "Error bar of the reference: 1.25 (|P1 - refined P2| + |P2 - refined P2| / (2^q - 1)) at the "
      "same vertices on a small sheet, q the order of P2 by the corners of the cell and of the "
      "sheet; carried to the full sheet by the measured ratio of |P1 - P2| (linear law) of the two "
      "sizes; 3 in place of 1.25 where |P2 - refined P2| is not smaller than |P1 - P2|; measured "
      "at "
      "small strain, 5 % and the largest strain, on lines per strain between.");
  if (options.budget)
    notes.emplace_back(
      "Error budget, of localized: every part is measured on its own; none is what others leave. "
      "The "
      "part `rest` is measured in linear theory, against the sheet of a second code, and scaled "
      "with "
      "strain; all others at the strain itself, on a homogenized sheet whose coarse mesh is "
      "refined "
      "four to sixteen times. What they leave of the error is `unexplained`: on a sheet mostly "
      "what "
      "`rest` does beyond linear theory. Its bar is how far the second code's sheet, the terms of "
      "edges and the cell have left linear theory. The sum tests that the method does what its "
      "parts "
      "say of it, the reference against the second code, with which it shares the mesh, the "
      "stiffness of the phases and the load, and part 2 under periodic loads. Part 4 and "
      "`reference` "
      "stand beside the sum: they hit method and reference alike, which share the mesh of the "
      "cell. "
      "Part 2 takes its stiffness and chi at finite strain from cell problems over the strains of "
      "the sheet, all but 0.5 % at either end of each component.");
  if (has_run_times(options))
    notes.emplace_back(
      "Run times: every run begins with the affine motion that agrees with what is prescribed; "
      "set-up that is done once per sheet is not counted. Parts of the machine that others use are "
      "not known to the clock.");
  return notes;
}
} // namespace

StudyDescription describe(const StrainStudyOptions &options, const StudyRecord &record,
                          const StudyCost &cost)
{
  std::vector<std::string> notes = notes_on_the_method(options, record);
  notes.insert(notes.end(), record.notes.begin(), record.notes.end());
  return {{{"strains", options.strains},
           {"loads", options.loads},
           {"references", options.references},
           {"methods", options.methods},
           {"cells_per_side", options.n_cells},
           {"threads_per_rank", 1},
           {"largest_relative_residual", cost.largest_residual},
           {"peak_memory_bytes", cost.peak_memory}},
          what_was_left_out(options),
          notes};
}

nlohmann::ordered_json strain_inputs(const StrainStudyOptions &asked,
                                     const std::vector<homogenization::UnitCell> &cells)
{
  const StrainStudyOptions options = options_of(asked, cells);
  nlohmann::ordered_json inputs    = {
       {"cells per side", options.n_cells},
       {"cells per side of the error bar", options.n_cells_of_error_bar},
       {"strains", options.strains},
       {"loads", options.loads},
       {"references", options.references},
       {"methods", options.methods},
       {"budget", options.budget}};
  if (has_supercell(options))
    inputs["supercell"] = options.supercell;
  if (options.keep)
    inputs["keep"] = true;
  for (const homogenization::UnitCell &cell : cells)
    inputs["references of " + cell.name] = options_of(asked, cell).references;
  return inputs;
}
} // namespace homespun::verification
