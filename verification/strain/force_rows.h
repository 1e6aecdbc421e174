// SPDX-License-Identifier: MIT
// What a load takes at one level, of the resolved sheet and of the coarse cloth beside it.
#pragma once

#include "verification/strain/compared_level.h"
#include "verification/strain/strain_tables.h"

#include <vector>

namespace homespun::verification
{
/// The rows of forces.csv of a level: resolved, coarse and affine. The force of `affine` is
/// in linear theory twice the energy over the way; under other laws a central difference of the
/// energy over a thousandth of the strain to either side, so that it lacks some 1e-6 of itself. It
/// is not a number where the coarse cloth finds no equilibrium there.
/// @param model without terms of edges, @param coarse its state at the level
std::vector<ForceRow> force_rows(const StrainLevel &level, const ResolvedLevel &resolved,
                                 const MethodsOnSheet &methods, const CoarseModel &model,
                                 const CoarseState &coarse);
} // namespace homespun::verification
