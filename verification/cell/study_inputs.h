// SPDX-License-Identifier: MIT
// By what the inputs of a study are recognised, so that rows of different inputs never stand in one
// table.
#pragma once

#include "homogenization/cell/unit_cell.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// A cell's name becomes a field of a table and a folder.
/// @throws BadInput where two cells share one, or one holds a comma, a quote or a line break
void check_names(const std::vector<homogenization::UnitCell> &cells);

/// A hash of a cell's mesh, with its curved sides, and lattice, and of stiffness and mass per area
/// of its phases.
std::string fingerprint(const homogenization::UnitCell &cell);

/// Which cells are not cut from the cloth as they are drawn, and by how much, and which have a size
/// that no cloth has: sentences for every result.
std::vector<std::string> notes_on_cells(const std::vector<homogenization::UnitCell> &cells);
} // namespace homespun::verification
