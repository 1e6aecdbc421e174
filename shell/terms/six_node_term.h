// SPDX-License-Identifier: MIT
// The membrane of a moving cloth of triangles with six nodes (six_node_membrane.h): membrane_term()
// at three points of a triangle, in the nodes by the chain rule; and its masses.
//
// Masses are lumped by diagonal scaling (Hinton, Rock and Zienkiewicz 1976): the diagonal of the
// consistent matrix, scaled to the mass of the triangle, which is 1/19 for a corner and 16/57 for
// the middle of a side. Row sums of the consistent matrix would leave corners without mass, and the
// cloth has no other stiffness out of its plane at rest. Total mass and centre of mass are exact,
// the moment of inertia is of second order in the size of a triangle.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/membrane/six_node_membrane.h"
#include "shell/terms/term.h"

#include <functional>
#include <memory>
#include <vector>

namespace homespun::shell
{
/// @param stiffness of all triangles [N/m]
/// @param viscosity, cubic as membrane_term() takes them; a term has no discrete gradient
/// @throws BadInput as six_node_membrane() and membrane_term() do
std::unique_ptr<Term> six_node_term(const SixNodeMesh &mesh, const Eigen::Matrix3d &stiffness,
                                    double viscosity                            = 0.,
                                    const std::vector<meshes::CubicForm> &cubic = {});

/// The same with another term of triangles of three nodes at the points, such as yarn_term().
/// @param of_points makes it for the points, whose cloth it is given: one phase, no triangle with a
///   corner of another; it couples the corners of a triangle alone
std::unique_ptr<Term>
six_node_term(const SixNodeMesh &mesh, const Eigen::Matrix3d &stiffness,
              const std::function<std::unique_ptr<Term>(const meshes::ClothMesh &)> &of_points);

/// @param areal_density [kg/m^2]
/// @return (n) [kg]
/// @throws BadInput where a node would have no mass, or the density is not positive
Eigen::VectorXd six_node_masses(const SixNodeMesh &mesh, double areal_density);
} // namespace homespun::shell
