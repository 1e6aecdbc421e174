// SPDX-License-Identifier: MIT
// The forces in a resolved cloth in space, from its positions alone: what holds a vertex that is
// held must be in balance with them. Eigen alone.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "verification/law/space_laws.h"

#include <vector>

namespace homespun::verification
{
/// dE/dx (n,3) of the energy of linear triangles, the sum of area x P grad N over the triangles at
/// each vertex [N]; the elastic forces are its negative.
/// @param rest flat rest mesh, rest.material being the phase of each triangle
/// @param stiffness_of_phase (3,3) [N/m]
/// @param law biot or green
/// @param positions (n,3) [m]
meshes::SpacePoints space_gradient(const meshes::TriangleMesh &rest,
                                   const std::vector<Eigen::Matrix3d> &stiffness_of_phase, Law law,
                                   const meshes::SpacePoints &positions);
} // namespace homespun::verification
