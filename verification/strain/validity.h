// SPDX-License-Identifier: MIT
// The range of validity: the largest strain up to which the up-sampled position stays within a
// limit of the reference, read off the rows of strain.csv. log error is taken linear in log strain
// between the levels of the ladder, and the limit counts as kept up to the first crossing.
#pragma once

#include "verification/strain/strain_tables.h"

#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
/// Where a curve meets a limit.
struct Crossing
{
  char relation = '-';
  double strain = 0.; ///< of the crossing; of the last level for '>', of the first for '-'
};

/// First crossing of a limit from below.
/// @param strains ascending, positive
/// @param errors >= 0, as many; zero counts as the smallest positive number
Crossing crossing(const std::vector<double> &strains, const std::vector<double> &errors,
                  double limit);

/// The strain at which the first triangle is lost, with `least` linear in strain between the levels
/// and 1 at rest.
/// @param rows of one cell, load, reference and part, in any order
/// @return not a number where every level is elliptic
double strain_of_loss(const std::vector<LevelRow> &rows);

/// The same, of the part that is lost first.
/// @param all rows of levels.csv
double elliptic_up_to(const std::vector<LevelRow> &all, const std::string &cell,
                      const std::string &load, const std::string &reference);

/// In place of a method's name: at each level the base of the main method (gains.h).
constexpr const char *base_method = "base";

/// Rows of validity.csv from those of strain.csv: `localized`, the main method of each case
/// (method/method.h) and its base, every reference, limits of 1, 5 and 10 % of the mean fluctuation
/// of the reference and 1 and 5 % of the cell side. Levels that were not reached end the ladder,
/// and the first loss of ellipticity, of the worst triangle of reference or coarse cloth, ends the
/// range: beyond it the reference is one equilibrium of its mesh. Its ends are those with the bar
/// of the error itself. Of a load without any level there are rows that say so.
/// @param levels rows of levels.csv, for the strain of the first loss
/// @param least_radius_of_cell from which on D^H holds, of each cell of which it is known [m]
std::vector<ValidityRow>
validity_rows(const std::vector<StrainRow> &rows, const std::vector<LevelRow> &levels = {},
              const std::map<std::string, double> &least_radius_of_cell = {});
} // namespace homespun::verification
