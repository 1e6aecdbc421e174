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

/// Why second order in strain is left out of a cell, as a sentence; empty where it is not: where
/// all laws of the cell together take no more than 10 s by an estimate. Studies that need it make
/// it whatever it takes.
std::string too_dear_second_order(const homogenization::UnitCell &cell,
                                  const homogenization::HomogenizationOptions &options);
} // namespace homespun::verification
