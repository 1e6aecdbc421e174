// SPDX-License-Identifier: MIT
// How far a C^H that theory knows to the last digit may be from it.
#pragma once

#include "homogenization/cell/unit_cell.h"

namespace homespun::verification
{
/// Largest over smallest eigenvalue of plane stiffnesses: of phases, or of one, its anisotropy.
double contrast_of(const std::vector<Eigen::Matrix3d> &stiffnesses);

/// What round-off and the solver may do to a C^H whose discrete problem is solved exactly by
/// theory, as the largest relative difference of an energy.
///
/// The error of the energy is the square of that of the displacement: of the tolerance 1e-11
/// nothing is left, so that 1e-11 covers the summation of up to 1e5 triangles. A stiff part held by
/// a soft one moves as a whole by what the sums of its large forces lose, 2e-16 of them per row of
/// triangles against the soft stiffness. The entries of a phase's stiffness are rounded in parts of
/// the largest: its softest direction keeps as many digits fewer as its anisotropy has.
/// @param rows of triangles along a side of the cell
double algebraic_limit(const homogenization::UnitCell &cell, double rows);
} // namespace homespun::verification
