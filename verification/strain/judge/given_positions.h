// SPDX-License-Identifier: MIT
// Positions of fine vertices that another program wrote.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <string>

namespace homespun::verification
{
struct GivenPositions
{
  meshes::Points points;  ///< (n,2) [m]
  double resolution = 0.; ///< distance between two numbers that the file can tell apart [m]
};

/// Reads .npy (float64 or float32), .h5 (dataset /positions), .obj or .ply; of three columns the
/// last must be zero, because sheets lie in the plane.
/// @param rest the mesh whose vertices they are; a file with faces must have its triangles
/// @throws BadInput naming the file, what was found and what was expected
GivenPositions read_positions(const std::string &file, const meshes::TriangleMesh &rest);
} // namespace homespun::verification
