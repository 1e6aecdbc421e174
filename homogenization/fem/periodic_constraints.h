// SPDX-License-Identifier: MIT
// Periodicity of displacements on a cell, by lattice matching. deal.II 9.4's own
// make_periodicity_constraints() orders the vertices of opposite triangle faces wrongly and ties
// nearly all of the boundary together, without an error; hence this file, and hence the audit.
#pragma once

#include "homogenization/fem/constraint_audit.h"
#include "homogenization/fem/discretization.h"
#include "meshes/plain/lattice.h"

#include <deal.II/lac/affine_constraints.h>

namespace homespun::homogenization
{
/// Ties every boundary node to its lattice image with the lowest DoF, u(x + n1 a1 + n2 a2) = u(x),
/// and holds the anchor and its images at zero, which takes out the two translations (periodicity
/// takes out the rotation). Corners end in one class. Nodes on the rims of holes stay free.
///
/// @param constraints receives the lines; it is reinitialised with the locally relevant DoFs and
///   the masters of their lines, which may live on another rank, and closed
/// @param anchor a point of the outline [m]
/// @param nodes of the boundary, of all ranks, sorted by DoF
/// @throws BadInput where nodes of the outline are left without an image
void make_periodic_constraints(const Discretization &discretization, const meshes::Lattice &lattice,
                               const Eigen::RowVector2d &anchor, const std::vector<Node> &nodes,
                               dealii::AffineConstraints<double> &constraints);

/// Holds closed periodic constraints against the coordinates of the nodes they tie, in every build:
/// each periodic line has one entry with factor one, ties equal components of exact lattice images,
/// and every node of the outline but one per class is tied.
/// Lines without entries fix a node; only images of the anchor may be fixed.
/// @param anchor where chi is held at zero [m]
/// @throws std::logic_error naming the DoFs and their points
ConstraintAudit audit_periodic_constraints(const Discretization &discretization,
                                           const meshes::Lattice &lattice,
                                           const Eigen::RowVector2d &anchor,
                                           const std::vector<Node> &nodes,
                                           const dealii::AffineConstraints<double> &constraints);
} // namespace homespun::homogenization
