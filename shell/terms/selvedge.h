// SPDX-License-Identifier: MIT
// The tension of a selvedge: what a periodic cloth does along a free edge beside its homogenized
// stiffness, to first order in the cell, is a cable sewn on it, of stiffness kappa of either sign:
//   E = Σ_segments L ½ kappa e²,   e = l/L − 1,   l the length of a segment, L at rest.
// Of a free edge along t the strain is that without traction, e times r with C^H r n = 0, r_tt = 1,
// so that the tension T_a E_a of the edge (meshes::CellEdge) is kappa e, kappa = Σ T_a r_a.
// A cable that pushes, kappa < 0, is well posed on a mesh as long as the triangle behind each
// segment is stiffer; no finer mesh is.
#pragma once

#include "shell/terms/term.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace homespun::shell
{
/// A piece of a free edge between two vertices.
struct SelvedgeSegment
{
  std::array<int, 2> vertices;
  double length;    ///< L > 0 [m]
  double stiffness; ///< kappa [N]
};

/// kappa of a free edge.
/// @param tension T_a per unit macro strain 11, 22, 12 [N]
/// @param stiffness C^H (3,3), symmetric positive definite [N/m]
/// @param along the edge, of any length, either way
/// @return [N]
double selvedge_stiffness(const Eigen::Vector3d &tension, const Eigen::Matrix3d &stiffness,
                          const Eigen::Vector2d &along);

/// The most negative kappa, as a positive number, that the triangles behind an edge bear: each has
/// half of the way across `height` over the compliance along the edge.
/// @param height of the triangles, across the edge [m]
/// @return [N]
double largest_push(const Eigen::Matrix3d &stiffness, const Eigen::Vector2d &along, double height);

/// The term. A projected Hessian leaves out what is negative, so that a step treats it explicitly.
/// @throws BadInput where a length is not positive or a number not finite
std::unique_ptr<Term> selvedge_term(std::vector<SelvedgeSegment> segments);
} // namespace homespun::shell
