// SPDX-License-Identifier: MIT
// A mesh as other programs write it at one moment of a motion: positions and faces, in the
// numbering of the file, so that a frame can be held against the mesh it is to be a frame of. Read
// are OBJ (obj_file.h) and PLY, text or binary little-endian; of PLY the properties x, y, z of
// `vertex` and the list `vertex_indices` or `vertex_index` of `face`, others are skipped.
#pragma once

#include "meshes/cloth/cloth_mesh.h"

#include <array>
#include <set>
#include <string>
#include <vector>

namespace homespun::meshes
{
/// Three or four vertices, counted from 0; the fourth is −1 of a triangle.
using Polygon = std::array<int, 4>;

struct Polygons
{
  SpacePoints positions;             ///< (n,3) in the unit of the file, finite
  std::vector<Polygon> faces;        ///< in the order of the file
  bool has_vt = false;               ///< whether it is an OBJ file and any face has vt
  std::set<std::string> passed_over; ///< keywords of ARCSim, which tell neither positions nor faces
};

/// Reads a file by its ending, .obj or .ply.
/// @throws BadInput naming file and line, or vertex or face from 0, what was found and expected
Polygons read_polygons(const std::string &file);

/// Reads PLY, see read_polygons().
Polygons read_ply(const std::string &file);
} // namespace homespun::meshes
