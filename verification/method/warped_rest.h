// SPDX-License-Identifier: MIT
// The paper's warped cloth (shell/terms/warping.h) at rest, as a way to the positions of a sheet.
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/triangle_mesh.h"
#include "shell/solver/equilibrium.h"

#include <vector>

namespace homespun::verification
{
/// The paper's warped cloth brought to rest: implicit steps so long that inertia plays no part,
/// each from rest.
/// @param start (n,2), with held vertices where they stay [m]
/// @throws NotConverged where it does not come to rest
shell::Positions<2> warped_rest(const meshes::TriangleMesh &coarse,
                                const meshes::HomogenizedCell &cell,
                                const shell::Positions<2> &start, const std::vector<int> &held);
} // namespace homespun::verification
