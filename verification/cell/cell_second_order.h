// SPDX-License-Identifier: MIT
// Whether a cell is given its quadratic modes and cubic energy by `homogenize`.
#pragma once

#include "homogenization/fem/homogenize.h"

#include <string>

namespace homespun::verification
{
/// Why second order in strain is left out of a cell, as a sentence; empty where it is not: where
/// all laws of the cell together take no more than 10 s by an estimate. Studies that need it make
/// it whatever it takes.
std::string too_dear_second_order(const homogenization::UnitCell &cell,
                                  const homogenization::HomogenizationOptions &options);
} // namespace homespun::verification
