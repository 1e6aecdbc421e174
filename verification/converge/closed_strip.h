// SPDX-License-Identifier: MIT
// A sheet without corners, in linear theory: n x n cells that close along the first axis, clamped
// below, free above, under a body force that goes round once. What homogenization with its terms of
// edges leaves there is of the next order in the cell, with nothing from corners in it.
//
// With s along the clamped edge, y along its normal n, k = 2 pi / (n |a1|) and the force
// Re(F e^(iks)), F = t − i n, the homogenized sheet is Re(U(y) e^(iks)): for all V with V(0) = 0
//   integral E(V)* C^H E(U0) dy = integral V* F dy,  E(U) = B_t ik U + B_n U'
//   integral E(V)* C^H E(U1) dy = −integral E_c(V)* M_abc d_b E_a(U0) dy
//                                 − (ik t.V)* T_a E_a(U0) at the top,
//   U1 = d_a E_a(U0) at y = 0,      d_b = t_b ik + n_b d/dy
// (homogenization/edges/edge_layers.h), solved in polynomials of high degree, to round-off. The
// resolved sheet is P1 on all its triangles, with the same force at its vertices, in holes put on
// the material around them: an independent writing, by one direct solve.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/homogenized_cell.h"
#include "verification/method/edge_terms.h"

namespace homespun::verification
{
/// Errors of one such sheet, mean over the vertices [m per mean macro strain].
struct ClosedStripErrors
{
  double full          = 0.; ///< with all terms of edges
  double localized     = 0.; ///< chi anchored, none of them
  unsigned long n_dofs = 0;
};

/// @throws NotConverged where the resolved sheet cannot be solved
ClosedStripErrors closed_strip_errors(const homogenization::UnitCell &cell,
                                      const CellModel &homogenized, int n);
} // namespace homespun::verification
