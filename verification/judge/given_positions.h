// SPDX-License-Identifier: MIT
// Positions of fine vertices that another program wrote.
#pragma once

#include "meshes/plain/triangle_mesh.h"
#include "verification/record/kept_positions.h"

#include <string>

namespace homespun::verification
{
struct GivenPositions
{
  PositionRows points;    ///< (n,2), or (n,3) in space [m]
  double resolution = 0.; ///< distance between two numbers that the file can tell apart: of float32
                          ///< or, in .obj, .ply and .vtu, of the digits of large coordinates [m]
};

/// Reads .npy (float64 or float32), .h5 (dataset /positions), .obj, .ply or, by meshio, .vtu. Of
/// sheets in their plane a third column may be there and must be zero.
/// @param triangles of the mesh, which .obj, .ply and .vtu must have, and .h5 where it has
///   a dataset /triangles
/// @param like positions of as many vertices and components
/// @throws BadInput naming the file, what was found and what was expected
GivenPositions read_positions(const std::string &file, const meshes::Triangles &triangles,
                              const PositionRows &like);
} // namespace homespun::verification
