// SPDX-License-Identifier: MIT
// The table of the range of validity: a strain study writes it, and whoever up-samples a motion of
// his own reads from it how far the cell may be strained.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <string>

namespace homespun::verification
{
/// validity.csv: the largest strain within a limit. `relation`:
///   =  the crossing was found
///   >  the limit is kept at every level; `largest` is the largest level
///   -  it is exceeded at the smallest level, `largest` is empty and `note` says by how much
///   ?  nothing is known, `largest` is empty and `note` says why
/// `lower` and `upper` are where the error with its own error bar added, and taken off, meets the
/// limit. `elliptic_up_to` is the strain of the load from which on a triangle of
/// reference or coarse cloth is not elliptic, the same for every measure and limit; empty where all
/// levels that were reached are. `least_radius_m` is the same for every row of a cell. Rows are of
/// `localized`, of the method that the study speaks of (method/method.h), and of its `base`, which
/// keeps the limit without up-sampling (gains.csv says which method that is at each level).
struct ValidityRow
{
  static constexpr const char *file   = "validity.csv";
  static constexpr std::size_t n_keys = 6;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load, reference, method, measure;
  double limit = 0.;
  std::string relation;
  double largest = none, lower = none, upper = none;
  std::string note;
  double elliptic_up_to = none;
  double least_radius   = none; ///< of a roll of the sheet along any direction: from there on it is
                              ///< at most 2 % stiffer than D^H; zero: always; empty: not known [m]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &ValidityRow::cell, Domain::name);
    column("load", &ValidityRow::load, Domain::name);
    column("reference", &ValidityRow::reference, Domain::name);
    column("method", &ValidityRow::method, Domain::name);
    column("measure", &ValidityRow::measure, Domain::name);
    column("limit", &ValidityRow::limit, Domain::positive);
    column("relation", &ValidityRow::relation, Domain::name);
    column("largest_strain", &ValidityRow::largest, Domain::not_negative);
    column("largest_strain_lower", &ValidityRow::lower, Domain::not_negative);
    column("largest_strain_upper", &ValidityRow::upper, Domain::not_negative);
    column("note", &ValidityRow::note, Domain::text);
    column("elliptic_up_to", &ValidityRow::elliptic_up_to, Domain::not_negative);
    column("least_radius_m", &ValidityRow::least_radius, Domain::not_negative);
  }
};
} // namespace homespun::verification
