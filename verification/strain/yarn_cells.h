// SPDX-License-Identifier: MIT
// What the law `yarn` makes of the phases of a cell: which have yarns, and which keep `biot`.
#pragma once

#include "homogenization/cell/unit_cell.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// @param references names of laws
/// @throws BadInput where the law `yarn` is asked for of a cell none of whose phases has axes
void check_yarns(const std::vector<homogenization::UnitCell> &cells,
                 const std::vector<std::string> &references);

/// Ready sentences: phases that keep `biot` under the law `yarn`, and the axes of those whose
/// stiffness has others than the orthotropic axes that are given; none where it is not asked for.
std::vector<std::string> notes_on_yarns(const std::vector<homogenization::UnitCell> &cells,
                                        const std::vector<std::string> &references);
} // namespace homespun::verification
