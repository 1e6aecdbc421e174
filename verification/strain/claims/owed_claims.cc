// SPDX-License-Identifier: MIT
#include "verification/strain/claims/owed_claims.h"

#include "verification/cell/study_of_cells.h"
#include "verification/law/laws.h"
#include "verification/method/method.h"
#include "verification/record/main_reference.h"
#include "verification/strain/budget/budget_rows.h"
#include "verification/strain/cell_references.h"
#include "verification/strain/claims/strain_verdicts.h"
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

/// What is owed of a load against one reference.
void add_case(const StrainStudyOptions &options, const Words &load, const std::string &reference,
              std::vector<OwedClaim> &owed)
{
  Words words        = load;
  words["reference"] = reference;
  owed.push_back({"equilibria", words});
  if (reference != name_of(Law::linear))
    owed.push_back({"minimum", words, "equilibria"});
  else if (!Load(load.at("load")).is_periodic() && has(options.methods, "affine"))
    owed.push_back({"force-of-reference", load, "equilibria"});
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
    for (const char *id :
         {"cell-file-energy", "cell-file-anchor", "phases-turned", "sheet-at-rest"})
      owed.push_back({id, of_cell});
    for (const std::string &reference : options.references)
      owed.push_back({"law-derivatives", {{"cell", cell.name}, {"reference", reference}}});
    const std::string main = main_reference(options.references);
    for (const std::string &load : options.loads)
    {
      Words words = {{"cell", cell.name}, {"load", load}};
      for (const std::string &reference : options.references)
        add_case(options, words, reference, owed);
      if (has_budget(options, Load(load)))
        add_budget(options, words, owed);
      words["reference"] = main;
      if (is_shared(main))
        add_main_case(options, words, owed);
    }
  }
  for (const char *id : {"norms", "read-back"})
    owed.push_back({id, {}});
  return owed;
}
} // namespace homespun::verification
