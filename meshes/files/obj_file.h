// SPDX-License-Identifier: MIT
// Wavefront OBJ: what every modelling program writes. Read are `v`, `vt` and `f` with three or four
// corners; negative indices count from the last vertex so far; o, g, s, vn, usemtl, mtllib and
// comments are skipped, and so is what ARCSim adds: ny, nv, nl, e, ea, ed, tl, tp, td, ms.
#pragma once

#include "meshes/cloth/cloth_faults.h"
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/files/polygons.h"

#include <string>

namespace homespun::meshes
{
/// Reads a cloth: v are positions in space in metres, vt the panels at rest.
///
/// A rest vertex is a pair of vt and v that some face uses, in the order of vt: panels that lie on
/// each other in the plane and share vt come apart. A quadrilateral is cut along the diagonal whose
/// two triangles are larger at rest. Materials are 0.
/// @param vt_unit metres per unit of vt [m]
/// @throws BadInput with the faults of all lines, or else those of cloth_faults()
ClothMesh read_cloth(const std::string &file, double vt_unit = 1.);

/// A cloth that is flat at rest, made of its rest mesh in a plane. Rest coordinates are x and y in
/// a plane z = const, x and −z where y is constant, y and z where x is; of any other plane, seen
/// from above, the first axis is that of x in it and the second to its left. Quadrilaterals are cut
/// as by read_cloth().
/// @param mesh [m]
/// @param name put before each message, usually the file
/// @throws BadInput where it is not flat, where faces run clockwise seen from there, or with
///   cloth_faults()
ClothMesh flat_cloth(const Polygons &mesh, const std::string &name);

/// Whether flat_cloth() finds a mesh flat.
bool is_flat(const Polygons &mesh);

/// Reads a closed surface, an obstacle; vt are not needed. A quadrilateral is cut along its shorter
/// diagonal.
/// @throws BadInput with the faults of all lines, or else those of surface_faults()
Surface read_surface(const std::string &file);

/// Writes positions and triangles with as many digits as read back the same numbers.
/// @throws BadInput where a position is not finite, or the file cannot be written
void write_obj(const std::string &file, const SpacePoints &positions, const Triangles &triangles);

/// Writes a cloth with its panels as vt in metres.
void write_obj(const std::string &file, const ClothMesh &cloth);
} // namespace homespun::meshes
