// SPDX-License-Identifier: MIT
// A homogenized cell as a few lines on the terminal.
#pragma once

#include "verification/cell/assessed_cell.h"

#include <string>

namespace homespun::verification
{
/// C^H and its engineering moduli as a table, with as many digits as the bracket justifies, or
/// without one the error bar.
std::string summary(const homogenization::UnitCell &cell, const AssessedCell &assessed);
} // namespace homespun::verification
