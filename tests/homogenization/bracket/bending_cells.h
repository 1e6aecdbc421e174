// SPDX-License-Identifier: MIT
// Phases of plates, and the bracket on what a cell of them bends with.
#pragma once

#include "homogenization/bracket/bending_bracket.h"
#include "tests/homogenization/bracket/bracket_cells.h"

namespace homespun::tests
{
/// In these cells the stiffness of each material is one of bending [N m].
inline homogenization::BendingBracket bent(const BracketCell &cell, const unsigned order = 2)
{
  return homogenization::bending_bracket(homogenization::glued(cell.mesh, cell.lattice),
                                         cell.stiffness, order);
}

inline Eigen::Matrix3d plate(const double E, const double nu, const double thickness)
{
  return homogenization::bending_stiffness(homogenization::isotropic("p", E, nu, thickness, 1.));
}

inline Eigen::Matrix3d yarn(const double angle, const double thickness)
{
  return homogenization::bending_stiffness({"y", 10., 1., 0.3, 0.4, angle, thickness, 1.});
}
} // namespace homespun::tests
