// SPDX-License-Identifier: MIT
// The rows of budget.csv.
#pragma once

#include "verification/record/table.h"

#include <string>

namespace homespun::verification
{
/// budget.csv: norms of one part of the error over one region.
struct BudgetRow
{
  static constexpr const char *file   = "budget.csv";
  static constexpr std::size_t n_keys = 6;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  double strain = 0.;
  std::string reference, part = {}, region = {};
  double mean = none, rms = none, max = none; ///< [m]
  double per_cell = none;                     ///< mean over the cell side
  double share    = none;                     ///< of the total

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &BudgetRow::cell, Domain::name);
    column("load", &BudgetRow::load, Domain::name);
    column("strain", &BudgetRow::strain, Domain::positive);
    column("reference", &BudgetRow::reference, Domain::name);
    column("part", &BudgetRow::part, Domain::name);
    column("region", &BudgetRow::region, Domain::name);
    column("mean_m", &BudgetRow::mean, Domain::not_negative);
    column("rms_m", &BudgetRow::rms, Domain::not_negative);
    column("max_m", &BudgetRow::max, Domain::not_negative);
    column("mean_per_cell", &BudgetRow::per_cell, Domain::not_negative);
    column("share", &BudgetRow::share, Domain::real);
  }
};
} // namespace homespun::verification
