// SPDX-License-Identifier: MIT
// Up to which strain a cell was found valid: read off validity.csv of a `homespun strain` run.
#pragma once

#include "localization/given_method.h"
#include "meshes/plain/homogenized_cell.h"

#include <optional>
#include <string>

namespace homespun::verification
{
/// The largest principal strain |E| up to which the mean error against the law that
/// coarse cloth and reference share, biot or yarn, stayed within a part
/// of the cell side at every load that was tried.
///
/// Of a load it is the largest singular value of F minus 1: the strain s itself, for shear
/// sqrt(1 + s²/4) + s/2 − 1, for `periodic-all` that of F = I + s [1 1; 0 ½]. A strip of an oblique
/// lattice counts as one of a rectangular lattice.
struct ValidStrain
{
  double strain = 0.;   ///< 0 where a load exceeds the limit at its smallest level already [-]
  std::string load;     ///< the one that decides
  std::string law;      ///< of the reference: biot, or where the table has none of it yarn
  std::string method;   ///< whose rows these are: the one that is used, or `localized`
  bool is_open = false; ///< the limit is kept at the largest level: more was not tried
  double limit = 0.;    ///< part of the cell side
  std::string cell, file;
  std::string unknown; ///< loads of which the table knows no range, with the reason
};

/// Whether two methods have the same terms where nothing bends, as in the sheets of the table.
bool are_alike_in_a_plane(const localization::Method &one, const localization::Method &other);

/// Reads the table. The run that wrote it has left its cells beside it: another lattice (by 1e-6),
/// or a C^H that differs by more than 5 %, far beyond what two meshes of one cell do, is another
/// cell.
/// @param cell what is in the file
/// @param cell_file cell.h5, whose folder names the cell where the table holds several
/// @param validity_file empty: validity.csv beside the cell, or in the folder above, if there is
/// one
/// @param limit one of those of the table
/// @param given the method; its own rows count where the table has them of its law and of all loads
/// that `localized` has, but of slip that up-sampling adds, which the studied cloths have
/// themselves; else those of `localized` do
/// @return nothing where no table is asked for and there is none, or one of another cell, and where
/// it knows no range
/// @throws BadInput where the table cannot be read, or lacks the cell, such a law or the limit, or
/// is asked for and of another cell
std::optional<ValidStrain> valid_strain(const meshes::HomogenizedCell &cell,
                                        const std::string &cell_file,
                                        const std::string &validity_file, double limit,
                                        const localization::GivenMethod &given);
} // namespace homespun::verification
