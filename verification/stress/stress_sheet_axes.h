// SPDX-License-Identifier: MIT
// What makes a step of a cloth hard, one thing at a time: its length, the stiffness of the sheet
// over its density, parts of other thickness or density, and how far the sheet turns in it.
#pragma once

#include "verification/stress/stress_axis.h"
#include "verification/stress/stress_sheet.h"

#include <vector>

namespace homespun::verification
{
/// Of a sheet hung by two corners and disturbed, whose energy never grows; of a free one that
/// spins, of which each integrator keeps what its theory says it keeps, and turns.
std::vector<StressAxis> sheet_axes(const SheetStiffness &stiffness);

/// Of the shipped scenes `hang` and `pull`, on a small sheet: up to which time step they are right.
std::vector<StressAxis> scene_axes(const SheetStiffness &stiffness);
} // namespace homespun::verification
