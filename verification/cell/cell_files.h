// SPDX-License-Identifier: MIT
// A homogenized cell as files.
#pragma once

#include "verification/cell/assessed_cell.h"

#include <string>

namespace homespun::verification
{
/// Writes homogenize.json, cell.h5, cell.json and characteristic-displacements.vtu into a folder.
/// To be called on one rank.
void write_cell_results(const homogenization::UnitCell &cell, const AssessedCell &assessed,
                        unsigned int n_ranks, const std::string &folder);
} // namespace homespun::verification
