// SPDX-License-Identifier: MIT
// What is counted where periodic constraints are held against the coordinates of their nodes.
#pragma once

namespace homespun::homogenization
{
/// What the audit counted; every entry came out of comparing constraints with coordinates.
struct ConstraintAudit
{
  unsigned int n_constrained = 0;  ///< DoFs tied to an image
  double largest_gap         = 0.; ///< between tied nodes, modulo the lattice [m]
};
} // namespace homespun::homogenization
