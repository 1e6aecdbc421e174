// SPDX-License-Identifier: MIT
// The table of patterns that a cloth takes beyond its first loss.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <string>

namespace homespun::verification
{
/// A pattern over several cells, beside the periodic state at the same strain, on the given mesh.
struct PatternRow
{
  static constexpr const char *file   = "pattern.csv";
  static constexpr std::size_t n_keys = 6;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, law, load;
  double strain = 0.;           ///< [-]
  int cells_1 = 0, cells_2 = 0; ///< that are solved as one
  /// `found`: with less energy; `no-wave`: every wave of these cells is stable; `not-found`: where
  /// the lowest wave leads to, Newton's method did not come to an end.
  std::string outcome;
  std::string wave;              ///< the lowest of these cells, that was followed, in words
  double beta            = none; ///< its margin in the periodic state [-]
  double energy_periodic = none; ///< per rest area [N/m]
  double energy          = none; ///< with the pattern [N/m]
  double lower           = none; ///< (energy_periodic - energy) / energy_periodic [-]
  double largest         = none; ///< distance between the two states, in sides of the cell [-]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &PatternRow::cell, Domain::name);
    column("law", &PatternRow::law, Domain::name);
    column("load", &PatternRow::load, Domain::name);
    column("strain", &PatternRow::strain, Domain::real);
    column("cells_1", &PatternRow::cells_1, Domain::positive);
    column("cells_2", &PatternRow::cells_2, Domain::positive);
    column("outcome", &PatternRow::outcome, Domain::name);
    column("wave", &PatternRow::wave, Domain::text);
    column("beta", &PatternRow::beta, Domain::real);
    column("energy_periodic_N_per_m", &PatternRow::energy_periodic, Domain::real);
    column("energy_N_per_m", &PatternRow::energy, Domain::real);
    column("lower", &PatternRow::lower, Domain::real);
    column("largest_per_cell", &PatternRow::largest, Domain::not_negative);
  }
};
} // namespace homespun::verification
