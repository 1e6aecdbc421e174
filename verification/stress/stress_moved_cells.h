// SPDX-License-Identifier: MIT
// Other descriptions of the same cloth: a cell that is moved, repeated, turned, mirrored or given
// in other units, whose C^H must be that of the cell, moved alike.
#pragma once

#include "verification/stress/stress_cells.h"

#include <vector>

namespace homespun::verification
{
/// n1 x n2 cells as one. @throws BadInput where the outline is no parallelogram
UnitCell repeated(const UnitCell &cell, int n1, int n2);

/// The cloth turned, mirrored or scaled in its plane: mesh, lattice and axes of the phases.
/// @param A rotation, reflection, or a multiple of either
UnitCell mapped(const UnitCell &cell, const Eigen::Matrix2d &A);

/// Factors of all lengths in the plane, of the thickness, of the moduli.
struct Units
{
  const char *name;
  double length, thickness, modulus;
};

UnitCell in_units(const UnitCell &cell, const Units &units);

/// A cell in all its descriptions, by linear elements on one rank.
std::vector<StressCase> moved_cell_cases(const UnitCell &cell);
} // namespace homespun::verification
