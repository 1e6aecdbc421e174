// SPDX-License-Identifier: MIT
// The rows of budget.csv and cross-checks.csv.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <optional>
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

/// cross-checks.csv: what computations of another kind say of a solution. `what`:
///   sheet     the reference and a second code's sheet, at one level of a load
///   p2-cell   C^H of P2 by two solvers; `load` and `reference` say nothing there
///   energies  the elastic energy of a small sheet in linear theory, between displacements above
///             and self-equilibrated stresses below
/// What a row has not, or a solver did not reach, is empty; `fault` says why.
struct CrossCheckRow
{
  static constexpr const char *file   = "cross-checks.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  double strain = 0.; ///< of energies any: they are proportional to its square
  std::string reference, what = {};
  double distance =
    none; ///< sheet: mean over the vertices, per strain and cell side; cell: energies
  std::string fault        = {};   ///< why there is no value
  std::optional<int> cells = {};   ///< per side of the sheet of the energies
  double upper             = none; ///< of the reference, P1 [J]
  double lower             = none; ///< of a self-equilibrated stress [J]
  double round_off         = none; ///< bound on what round-off does to both together [J]
  double bar = none; ///< sqrt((upper − lower + round_off) / upper): the reference is no further
                     ///< from the solution than this, in the energy norm and relative to its own
  double p2             = none; ///< energy of P2 on the same mesh [J]
  double p1_to_p2       = none; ///< sqrt((upper − p2) / upper), their distance in the same norm
  double misfit         = none; ///< |energy − work| of the reference by Clapeyron's theorem [J]
  double largest_misfit = none; ///< that the forces left by its solver explain [J]
  double seconds        = none; ///< of the energies
  double seconds_lower  = none; ///< of the stresses alone

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &CrossCheckRow::cell, Domain::name);
    column("load", &CrossCheckRow::load, Domain::name);
    column("strain", &CrossCheckRow::strain, Domain::positive);
    column("reference", &CrossCheckRow::reference, Domain::name);
    column("what", &CrossCheckRow::what, Domain::name);
    column("distance", &CrossCheckRow::distance, Domain::not_negative);
    column("fault", &CrossCheckRow::fault, Domain::text);
    column("cells", &CrossCheckRow::cells, Domain::not_negative);
    column("energy_upper_J", &CrossCheckRow::upper, Domain::not_negative);
    column("energy_lower_J", &CrossCheckRow::lower, Domain::real);
    column("energy_round_off_J", &CrossCheckRow::round_off, Domain::not_negative);
    column("error_bar_energy_norm", &CrossCheckRow::bar, Domain::not_negative);
    column("energy_p2_J", &CrossCheckRow::p2, Domain::not_negative);
    column("p1_minus_p2_energy_norm", &CrossCheckRow::p1_to_p2, Domain::not_negative);
    column("work_misfit_J", &CrossCheckRow::misfit, Domain::not_negative);
    column("largest_work_misfit_J", &CrossCheckRow::largest_misfit, Domain::not_negative);
    column("seconds", &CrossCheckRow::seconds, Domain::not_negative);
    column("seconds_lower", &CrossCheckRow::seconds_lower, Domain::not_negative);
  }
};
} // namespace homespun::verification
