// SPDX-License-Identifier: MIT
// Cases that test the program and no limit of a cloth: steps of the tests that are named here.
#pragma once

#include "verification/extremes/stress_case.h"
#include "verification/extremes/stress_sheet.h"

#include <vector>

namespace homespun::verification
{
/// Sound and unsound meshes: `unsound_meshes_are_refused_and_sound_ones_hang`.
std::vector<StressCase> mesh_cases(const SheetStiffness &stiffness);

/// One triangle turned, mirrored, collapsed, scaled; numbers that are not finite; twisted strips:
/// `turned_and_crushed_triangles_end_as_theory_says`.
std::vector<StressCase> rotation_cases(const std::vector<SheetStiffness> &stiffnesses);
} // namespace homespun::verification
