// SPDX-License-Identifier: MIT
// A homogenized cell as files.
#pragma once

#include "verification/cell/assessed_cell.h"
#include "verification/cell/sensitivity.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Writes homogenize.json, cell.h5, cell.json and characteristic-displacements.vtu into a folder,
/// which is made; where D^H is known, shell-section-abaqus.inp and shell-section-code_aster.comm.
/// To be called on one rank.
void write_cell_results(const homogenization::UnitCell &cell, const AssessedCell &assessed,
                        const std::vector<UncertainInput> &uncertain, unsigned int n_ranks,
                        const std::string &folder);
} // namespace homespun::verification
