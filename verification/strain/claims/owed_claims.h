// SPDX-License-Identifier: MIT
// The claims that a strain study owes, by what it was asked for alone.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/record/claim.h"
#include "verification/strain/strain_options.h"

#include <vector>

namespace homespun::verification
{
std::vector<OwedClaim> owed_of_strain(const StrainStudyOptions &asked,
                                      const std::vector<homogenization::UnitCell> &cells);
} // namespace homespun::verification
