// SPDX-License-Identifier: MIT
// What makes a step of a cloth hard, one parameter at a time: its length, the stiffness and the
// density of the sheet, and how far the sheet turns in it.
#pragma once

#include "verification/stress/stress_case.h"
#include "verification/stress/stress_sheet.h"

#include <vector>

namespace homespun::verification
{
/// Hung by two corners and disturbed, at steps of 1e-5 to 1 s: the energy never grows.
std::vector<StressCase> time_step_cases(const std::vector<SheetStiffness> &stiffnesses);

/// The same at 5 ms of 1e-2 to 1e8 N/m times 0.01 to 10 kg/m^2.
std::vector<StressCase> stiffness_cases();

/// Up to which turn per step of 10 ms each integrator keeps what its theory says it keeps, and
/// turns.
std::vector<StressCase> spin_cases(const std::vector<SheetStiffness> &stiffnesses);
} // namespace homespun::verification
