// SPDX-License-Identifier: MIT
// What up-sampling of a bent sheet is worth, and the claims about it.
#pragma once

#include "verification/bend/bend_tables.h"
#include "verification/record/claim.h"
#include "verification/record/verdict.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Of the position and of the normal that `full` is closer to the reference than its base, the
/// better of `affine` and `affine+edges`, which have no deflection of the cell; that it is closer
/// than `affine`; and the same of `localized`, whose base is `affine`. By more than the error bars
/// of both; FAIL where it is farther by more than that; open within them, where a method or a bar
/// is not known, and where both errors are what the solvers leave.
/// @param of names cell, load and reference
/// @param rows of them at one curvature; none where no equilibrium was found
std::vector<Verdict> verdicts_on_bending(const BendRow &of, const std::vector<BendRow> &rows);

/// That the sheet wrinkles no later than as a wave without fluctuation, within its error bar; open
/// where no wave was found.
Verdict verdict_on_wrinkles(const WrinkleRow &row);

/// The claims of verdicts_on_bending().
void add_owed_of_bending(const std::string &cell, const std::string &load,
                         const std::string &reference, std::vector<OwedClaim> &owed);

/// The claims of verdict_on_wrinkles() for each axis.
void add_owed_of_wrinkles(const std::string &cell, const std::vector<int> &cells_per_wave,
                          std::vector<OwedClaim> &owed);
} // namespace homespun::verification
