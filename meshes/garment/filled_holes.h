// SPDX-License-Identifier: MIT
// A cell whose holes are filled with triangles, so that cells cover the plane and any outline can
// be cut out of them. Private to fine_cloth.
#pragma once

#include "meshes/plain/triangle_mesh.h"

namespace homespun::meshes
{
/// The material of the triangles in holes.
constexpr int hole = -1;

/// The mesh with its holes filled: the same vertices, behind the given triangles those between the
/// vertices of each rim, of material `hole`.
/// @throws BadInput where a rim crosses itself
TriangleMesh filled_holes(const TriangleMesh &mesh);
} // namespace homespun::meshes
