// SPDX-License-Identifier: MIT
// The rows of budget.csv and second-code.csv.
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

/// second-code.csv: what two codes that solve one discrete problem differ by. `what`:
///   sheet    the reference and the second code's sheet, at one level of a load
///   p2-cell  C^H of P2 by both solvers; `load` and `reference` say nothing there
struct SecondCodeRow
{
  static constexpr const char *file   = "second-code.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  double strain = 0.;
  std::string reference, what = {};
  double distance =
    none; ///< sheet: mean over the vertices, per strain and cell side; cell: energies
  std::string fault = {}; ///< why there is no distance

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &SecondCodeRow::cell, Domain::name);
    column("load", &SecondCodeRow::load, Domain::name);
    column("strain", &SecondCodeRow::strain, Domain::positive);
    column("reference", &SecondCodeRow::reference, Domain::name);
    column("what", &SecondCodeRow::what, Domain::name);
    column("distance", &SecondCodeRow::distance, Domain::not_negative);
    column("fault", &SecondCodeRow::fault, Domain::text);
  }
};
} // namespace homespun::verification
