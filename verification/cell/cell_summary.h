// SPDX-License-Identifier: MIT
// A homogenized cell as a few lines on the terminal.
#pragma once

#include "verification/cell/assessed_cell.h"
#include "verification/cell/sensitivity.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// C^H, D^H and their moduli as tables, with as many digits as the bracket justifies, or
/// without one the error bar.
/// @param uncertain inputs, whose bars stand beside those of the bracket
std::string summary(const homogenization::UnitCell &cell, const AssessedCell &assessed,
                    const std::vector<UncertainInput> &uncertain = {});
} // namespace homespun::verification
