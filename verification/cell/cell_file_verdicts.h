// SPDX-License-Identifier: MIT
// cell.h5 held against what it says of itself, as a reader finds it who knows only that.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/record/verdict.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Claims on the cell.h5 of a P1 homogenization on the given mesh:
/// - /C is 1/|Y| integral (E − eps(chi)):c:(E − eps(chi)), with /chi as its attribute `convention`
///   has it and c of the phases
/// - the anchor of /chi has as many lattice images in the mesh as any vertex: it is a lattice point
///   of the cell, where there is one
/// @throws BadInput where the file cannot be read
std::vector<Verdict> cell_file_verdicts(const std::string &file,
                                        const homogenization::UnitCell &cell);
} // namespace homespun::verification
