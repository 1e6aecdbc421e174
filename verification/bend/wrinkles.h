// SPDX-License-Identifier: MIT
// Where a pressed sheet begins to wrinkle, resolved on one cell and by D^H: what can be verified of
// wrinkles without a sheet of so many cells that no reference resolves them.
#pragma once

#include "verification/bend/bend_tables.h"
#include "verification/bend/cell_twice.h"

#include <vector>

namespace homespun::verification
{
/// For each lattice vector, along which the sheet is pressed, and each number of cells per wave: a
/// row, with the foundation (homogenization/bracket/plate_waves.h) that makes D^H wrinkle in waves
/// of so many cells. What is resolved is none where waves do not converge.
std::vector<WrinkleRow> wrinkles(const CellTwice &cell, const std::vector<int> &cells_per_wave);
} // namespace homespun::verification
