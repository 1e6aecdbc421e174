// SPDX-License-Identifier: MIT
// A mesh without symmetry that is always the same: what solvers are tried on.
#pragma once

#include "meshes/cloth/cloth_mesh.h"

#include <Eigen/Core>

namespace homespun::meshes
{
/// Independent numbers between −1 and 1, (n,3).
SpacePoints random_vectors(Eigen::Index n, unsigned int seed);

/// n x n x 2 triangles; inner vertices moved by up to a quarter of the mesh width, always the same.
/// @param side of the square [m]
TriangleMesh irregular_sheet(int n, double side);
} // namespace homespun::meshes
