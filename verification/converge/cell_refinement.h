// SPDX-License-Identifier: MIT
// What C^H of a cell must show under uniform refinement, with P1 and P2. Spaces are nested: it
// falls in the Loewner order. A cell without corners is a laminate, and C^H its closed form on
// every mesh. At corners the energy converges with order 2 lambda, lambda the exponents of
// corners.h; and a C^H that does not change with the mesh is a fault there. The corners give P1 and
// P2 the same order, so that what tells them apart is that P2 lies below P1 on the same mesh.
//
// How far an observed order may be from that: a sum of powers of h shows orders between those of
// its parts. P1 adds the h^2 of the smooth part, which no ladder tells from h^1.5 (the order of
// such a sum changes by less than what counts as settled): 2 lambda_min to 2. P2's own h^4 stands
// far off, but the corners have exponents above 1 too, the weak ones of a polygon that stands for a
// circle more of them than below: 2 lambda_min to twice the smallest above 1. Tolerance 0.1 at both
// ends.
#pragma once

#include "homogenization/cell/corners.h"
#include "homogenization/cell/unit_cell.h"
#include "verification/converge/converge_record.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::verification
{
/// C^H on one mesh.
struct RefinedCell
{
  double h; ///< sqrt of the mean area of the triangles over the cell side
  unsigned long n_dofs;
  Eigen::Matrix3d stiffness; ///< [N/m]
  double seconds;
};

/// Meshes of one order, coarse to fine.
struct RefinementLadder
{
  unsigned int order; ///< 1 or 2
  std::vector<RefinedCell> levels;
};

/// The orders that the energy may show.
OrderLimit order_of_energy(const homogenization::Singularity &singularity, unsigned int order);

/// Judges the ladders of P1 and P2 of a cell, in this order: trace and entries of C^H as series,
/// and the claims above. A ladder may have ended early, or be empty.
void judge_refinements(const homogenization::UnitCell &cell,
                       const std::vector<RefinementLadder> &ladders, ConvergenceResult &result);
} // namespace homespun::verification
