// SPDX-License-Identifier: MIT
// The rows of energies.csv.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <string>

namespace homespun::verification
{
/// energies.csv: the elastic energy of a sheet in linear theory, between displacements above and
/// self-equilibrated stresses below. Not a number where a solver did not converge; `fault` says
/// why.
struct EnergyRow
{
  static constexpr const char *file   = "energies.csv";
  static constexpr std::size_t n_keys = 2;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  int cells        = 0;    ///< per side of the sheet
  double strain    = 0.;   ///< any: energies are proportional to its square
  double upper     = none; ///< of the reference, P1 [J]
  double lower     = none; ///< of a self-equilibrated stress [J]
  double round_off = none; ///< bound on what round-off does to both together [J]
  double bar = none; ///< sqrt((upper − lower + round_off) / upper): the reference is no further
                     ///< from the solution than this, in the energy norm and relative to its own
  double p2             = none; ///< energy of P2 on the same mesh [J]
  double p1_to_p2       = none; ///< sqrt((upper − p2) / upper), their distance in the same norm
  double misfit         = none; ///< |energy − work| of the reference by Clapeyron's theorem [J]
  double largest_misfit = none; ///< that the forces left by its solver explain [J]
  double seconds        = none; ///< of all of this
  double seconds_lower  = none; ///< of the stresses alone
  std::string fault     = {};

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &EnergyRow::cell, Domain::name);
    column("load", &EnergyRow::load, Domain::name);
    column("cells", &EnergyRow::cells, Domain::positive);
    column("strain", &EnergyRow::strain, Domain::positive);
    column("energy_upper_J", &EnergyRow::upper, Domain::not_negative);
    column("energy_lower_J", &EnergyRow::lower, Domain::real);
    column("energy_round_off_J", &EnergyRow::round_off, Domain::not_negative);
    column("error_bar_energy_norm", &EnergyRow::bar, Domain::not_negative);
    column("energy_p2_J", &EnergyRow::p2, Domain::not_negative);
    column("p1_minus_p2_energy_norm", &EnergyRow::p1_to_p2, Domain::not_negative);
    column("work_misfit_J", &EnergyRow::misfit, Domain::not_negative);
    column("largest_work_misfit_J", &EnergyRow::largest_misfit, Domain::not_negative);
    column("seconds", &EnergyRow::seconds, Domain::not_negative);
    column("seconds_lower", &EnergyRow::seconds_lower, Domain::not_negative);
    column("fault", &EnergyRow::fault, Domain::text);
  }
};
} // namespace homespun::verification
