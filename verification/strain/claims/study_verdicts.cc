// SPDX-License-Identifier: MIT
#include "verification/strain/claims/study_verdicts.h"

#include "verification/strain/budget/energy_sides.h"
#include "verification/strain/budget/second_code.h"
#include "verification/strain/claims/budget_verdicts.h"
#include "verification/strain/claims/strain_verdicts.h"
#include "verification/strain/claims/table_verdicts.h"

namespace homespun::verification
{
std::vector<Verdict> study_verdicts(const StrainOutput &output, const StrainStudyOptions &options)
{
  std::vector<Verdict> verdicts =
    strain_verdicts(output.strain_rows(), options.strains, output.level_rows(), options.methods);
  const auto add = [&](const std::vector<Verdict> &some)
  { verdicts.insert(verdicts.end(), some.begin(), some.end()); };
  add(stability_verdicts(output.level_rows()));
  if (options.budget)
  {
    const std::vector<BudgetRow> &rows = output.budget->rows();
    std::vector<StrainRow> with_budget;
    for (const StrainRow &row : output.strain_rows())
      if (has_budget(options, Load(row.load)))
        with_budget.push_back(row);
    add(budget_verdicts(with_budget, rows, options.strains));
    add(error_agreement_verdicts(with_budget, rows));
    add(second_code_verdicts(output.checks->rows()));
    add(energy_verdicts(output.checks->rows()));
  }
  add(verdicts_of_nested_forces(output.uncertainty.rows()));
  add(verdicts_of_forces(output.force_rows()));
  add({verdict_of_norms(output.strain_rows()),
       verdict_of_reading(output.strain_rows(), options.output)});
  return verdicts;
}
} // namespace homespun::verification
