// SPDX-License-Identifier: MIT
// What the parts of a strain study must do on any cell, asked of this one before anything is
// solved.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/law/laws.h"
#include "verification/record/verdict.h"

#include <vector>

namespace homespun::verification
{
/// - one claim per law: for every phase, along stretches, shear and a mixed path up to the given
///   strain, P = dW/dF and dP/dF by central differences
/// - the stiffness of every phase, turned with its axes, gives turned strains the same energy
/// - the resolved homogenized sheet, at rest, puts every vertex of a cell where it is
std::vector<Verdict> self_checks(const homogenization::UnitCell &cell, const std::vector<Law> &laws,
                                 double strain);
} // namespace homespun::verification
