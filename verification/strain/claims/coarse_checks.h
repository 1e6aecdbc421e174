// SPDX-License-Identifier: MIT
// What the coarse cloths and the cell of a strain study must do, asked of this cell on small
// sheets.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "localization/method.h"
#include "verification/record/verdict.h"

#include <vector>

namespace homespun::verification
{
/// - on 4 x 4 cells, under both strips, the coarse cloth with six-node triangles and the terms of
///   edges that are known comes to its linear theory: the difference of positions over strain falls
///   with the strain, of order 1; open where it finds no equilibrium, and where C^H is ten
///   thousand times stiffer in one direction than in another
/// - six-node triangles of C^H have the energy of a quadratic displacement in closed form
/// - chi with the constant that terms of edges want has the mean zero
/// - those of second_order_checks()
/// - those of layer_checks(), where edges are known, of cells of at most 8000 triangles; open where
///   a sheet finds no equilibrium
std::vector<Verdict> coarse_checks(const homogenization::UnitCell &cell,
                                   const localization::CellModel &model);
} // namespace homespun::verification
