// SPDX-License-Identifier: MIT
// Universal Scene Description as text, .usda: what Houdini, Maya, Blender and Omniverse read. One
// prim `Mesh` of triangles per file, in metres; reference "Universal Scene Description,
// UsdGeomMesh" of openusd.org.
#pragma once

#include "meshes/files/surface_files.h"

#include <string>

namespace homespun::meshes
{
/// Which axis of the positions points up; it is said, positions are not turned.
enum class UpAxis
{
  y,
  z
};

/// Writes positions and triangles; every float is written with as many digits as read it back.
/// @param positions (n,3) [m]
/// @throws BadInput where a position is not finite, a triangle names no vertex, or the file cannot
///   be written
void write_usda(const std::string &file, const FloatPoints &positions, const Triangles &triangles,
                UpAxis up);
} // namespace homespun::meshes
