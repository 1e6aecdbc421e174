// SPDX-License-Identifier: MIT
// The claims that a strain study owes, by what it was asked for alone, and all that it claims of
// its tables.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/record/claim.h"
#include "verification/strain/strain_options.h"
#include "verification/strain/strain_output.h"

#include <vector>

namespace homespun::verification
{
std::vector<OwedClaim> owed_of_strain(const StrainStudyOptions &asked,
                                      const std::vector<homogenization::UnitCell> &cells);

/// All that it claims of one cell once its loads are done.
std::vector<Verdict> cell_verdicts(const StrainOutput &output, const StrainStudyOptions &options,
                                   const homogenization::UnitCell &cell,
                                   const meshes::HomogenizedCell &homogenized);

/// In the order of the report.
/// @throws BadInput where a table cannot be read back
std::vector<Verdict> study_verdicts(const StrainOutput &output, const StrainStudyOptions &options);
} // namespace homespun::verification
