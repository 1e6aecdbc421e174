// SPDX-License-Identifier: MIT
#include "verification/strain/claims/study_claims.h"

#include "verification/cell/study_of_cells.h"
#include "verification/law/laws.h"
#include "verification/method/method.h"
#include "verification/record/main_reference.h"
#include "verification/strain/budget/budget_rows.h"
#include "verification/strain/budget/energy_sides.h"
#include "verification/strain/cell_references.h"
#include "verification/strain/claims/budget_verdicts.h"
#include "verification/strain/claims/cubic_verdicts.h"
#include "verification/strain/claims/force_verdicts.h"
#include "verification/strain/claims/strain_verdicts.h"
#include "verification/strain/claims/table_verdicts.h"
#include "verification/strain/gains.h"

#include <algorithm>

namespace homespun::verification
{
namespace
{
bool has(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether there are bars of errors whose coarse motion is prescribed.
bool has_prescribed_motion(const StrainStudyOptions &options)
{
  return options.n_cells_of_error_bar > 0 && has(options.methods, "affine") &&
         std::any_of(options.loads.begin(), options.loads.end(),
                     [](const std::string &load) { return prescribes_motion(Load(load)); });
}

/// What is owed of a load against one reference.
void add_case(const StrainStudyOptions &options, const Words &load, const std::string &reference,
              std::vector<OwedClaim> &owed)
{
  Words words        = load;
  words["reference"] = reference;
  owed.push_back({"equilibria", words});
  if (has_cubic_claim(options, Load(load.at("load")), law_of(reference)))
    owed.push_back({"cubic-energy", words});
  if (has_claim_on_laws(options, law_of(reference)))
    owed.push_back({"laws-agree", words});
  if (reference != name_of(Law::linear))
    owed.push_back({"minimum", words, {"equilibria"}});
  else if (!Load(load.at("load")).is_periodic() && has(options.methods, "affine"))
    owed.push_back({"force-of-reference", load, {"equilibria"}});
}

/// What is owed of a load against the reference that claims on methods speak of.
void add_main_case(const StrainStudyOptions &options, const Words &words,
                   std::vector<OwedClaim> &owed)
{
  const Load load(words.at("load"));
  const Law law = law_of(words.at("reference"));
  if (load.is_periodic())
  {
    if (decides_slope(options.strains))
      owed.push_back({"strain-squared", words});
    return;
  }
  const std::vector<std::string> methods = distinct_methods(options.methods, law, load);
  for (const double strain : strains_of_methods(options.strains))
  {
    Words at_level     = words;
    at_level["strain"] = strain;
    if (main_method(methods) != "localized")
      owed.push_back({"closer-than.base", at_level});
    if (has(methods, "localized") && has(methods, "affine"))
      owed.push_back({"closer-than.affine", at_level});
  }
}

void add_budget(const StrainStudyOptions &options, const Words &words, std::vector<OwedClaim> &owed)
{
  for (const double strain : judged_strains(options.strains))
  {
    Words at_level      = words;
    at_level["percent"] = 100. * strain;
    owed.push_back({"budget", at_level});
  }
  if (Load(words.at("load")).is_periodic())
    return;
  for (const char *id : {"energy-above-stress", "energy-of-p2", "energy-is-work"})
    owed.push_back({id, words});
}
} // namespace

std::vector<OwedClaim> owed_of_strain(const StrainStudyOptions &asked,
                                      const std::vector<homogenization::UnitCell> &cells)
{
  std::vector<OwedClaim> owed = owed_of_cells(cells);
  for (const homogenization::UnitCell &cell : cells)
  {
    const StrainStudyOptions options = options_of(asked, cell);
    const Words of_cell              = {{"cell", cell.name}};
    for (const char *id : {"cell-file-energy", "cell-file-anchor", "phases-turned", "sheet-at-rest",
                           "linear-limit", "six-node-energy", "chi-of-mean-zero"})
      owed.push_back({id, of_cell});
    for (const std::string &reference : options.references)
      owed.push_back({"law-derivatives", {{"cell", cell.name}, {"reference", reference}}});
    for (const Law law : laws_of_second_order(options))
      for (const char *id : {"second-order", "cubic-guard"})
        owed.push_back({id, {{"cell", cell.name}, {"reference", name_of(law)}}});
    const std::string linear = name_of(Law::linear);
    if (has(options.references, linear) && options.strains.size() > 1)
      owed.push_back({"proportional", of_cell, {"equilibria"}});
    if (options.n_cells > 3 &&
        std::any_of(options.loads.begin(), options.loads.end(),
                    [](const std::string &load) { return !Load(load).is_periodic(); }))
      owed.push_back({"parts-of-mean", of_cell, {"equilibria"}});
    if (has_prescribed_motion(options))
      owed.push_back({"bars-of-prescribed-motion", of_cell, {"equilibria"}});
    const std::string main = main_reference(options.references);
    for (const std::string &load : options.loads)
    {
      Words words = {{"cell", cell.name}, {"load", load}};
      for (const std::string &reference : options.references)
        add_case(options, words, reference, owed);
      if (!Load(load).is_periodic())
        owed.push_back({"clamp-travel", words});
      else if (prescribes_motion(Load(load)))
        owed.push_back({"no-moment", words});
      if (has_budget(options, Load(load)))
        add_budget(options, words, owed);
      words["reference"] = main;
      if (is_shared(main))
        add_main_case(options, words, owed);
    }
  }
  for (const char *id : {"norms", "read-back"})
    owed.push_back({id, {}});
  if (asked.n_cells_of_error_bar > 0)
    owed.push_back({"triangles", {}});
  return owed;
}

std::vector<Verdict> cell_verdicts(const StrainOutput &output, const StrainStudyOptions &options,
                                   const homogenization::UnitCell &cell,
                                   const meshes::HomogenizedCell &homogenized)
{
  const std::vector<ForceRow> &forces = output.forces.rows();
  const std::vector<LevelRow> &levels = output.levels.rows();
  std::vector<Verdict> verdicts       = cubic_verdicts(forces, levels, options, cell, homogenized);
  for (const auto &some :
       {verdicts_of_laws(forces, levels, options, cell, homogenized.stiffness),
        verdicts_of_moments(forces, options, cell), verdicts_of_travel(forces, options, cell),
        verdicts_of_parts(output.strain.rows(), cell),
        verdicts_of_proportions(output.strain.rows(), forces, cell, left_in_stress(cell))})
    verdicts.insert(verdicts.end(), some.begin(), some.end());
  if (has_prescribed_motion(options))
    verdicts.push_back(verdict_of_prescribed_motion(output.uncertainty.rows(), cell));
  return verdicts;
}

std::vector<Verdict> study_verdicts(const StrainOutput &output, const StrainStudyOptions &options)
{
  std::vector<Verdict> verdicts =
    strain_verdicts(output.strain.rows(), options.strains, output.levels.rows(), options.methods);
  const auto add = [&](const std::vector<Verdict> &some)
  { verdicts.insert(verdicts.end(), some.begin(), some.end()); };
  add(stability_verdicts(output.levels.rows()));
  if (options.budget)
  {
    const std::vector<BudgetRow> &rows = output.budget->rows();
    std::vector<StrainRow> with_budget;
    for (const StrainRow &row : output.strain.rows())
      if (has_budget(options, Load(row.load)))
        with_budget.push_back(row);
    add(budget_verdicts(with_budget, rows, options.strains, output.levels.rows()));
    add(error_agreement_verdicts(with_budget, rows));
    add(second_code_verdicts(output.checks->rows(), output.levels.rows()));
    add(energy_verdicts(output.checks->rows()));
  }
  add(verdicts_of_nested_forces(output.uncertainty.rows()));
  add(verdicts_of_forces(output.forces.rows()));
  if (options.n_cells_of_error_bar > 0)
    add({verdict_of_triangles(output.uncertainty.rows())});
  const std::vector<GainRow> gains = gain_rows(output.strain.rows());
  if (!gains.empty())
    add({verdict_of_bases(gains, output.strain.rows())});
  add({verdict_of_norms(output.strain.rows()),
       verdict_of_reading(output.strain.rows(), options.output)});
  return verdicts;
}
} // namespace homespun::verification
