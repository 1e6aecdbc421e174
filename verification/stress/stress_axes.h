// SPDX-License-Identifier: MIT
// What makes a cell problem hard, one thing at a time: contrast, anisotropy, Poisson's ratio,
// thickness, slivers, size; and what must change nothing: a cell that is turned and mirrored,
// moved, repeated, or in other units.
#pragma once

#include "verification/stress/stress_axis.h"
#include "verification/stress/stress_cells.h"

#include <vector>

namespace homespun::verification
{
/// C^H of linear elements on one rank: against the closed form where the cell is a laminate, else
/// against the same discrete problem by a sparse factorization, apart from deal.II; and against
/// Voigt and Reuss. By the energy of the worst macro strain.
/// @param most_triangles of the largest cell
std::vector<StressAxis> cell_axes(const UnitCell &cell, int most_triangles);
} // namespace homespun::verification
