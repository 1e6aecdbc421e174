// SPDX-License-Identifier: MIT
// Uniform refinement of a plain mesh: each triangle into four alike. The vertices of the given mesh
// keep their indices, so that a refined solution is read off at them without any search; triangle t
// becomes triangles 4 t ... 4 t + 3.
#pragma once

#include "meshes/plain/triangle_mesh.h"

namespace homespun::meshes
{
/// The mesh after `times` uniform refinements; edge midpoints are appended to the vertices.
TriangleMesh refined(const TriangleMesh &mesh, int times);
} // namespace homespun::meshes
