// SPDX-License-Identifier: MIT
// All that makes a cloth or an obstacle unusable, one message per fault. Vertices and triangles are
// counted from 0, in the order of the file. All tolerances are relative to the edges at hand, so
// that neither the unit nor the place of a mesh matters.
#pragma once

#include "meshes/cloth/cloth_mesh.h"

#include <string>
#include <vector>

namespace homespun::meshes
{
/// A closed surface of triangles in space, counter-clockwise seen from outside: an obstacle.
struct Surface
{
  SpacePoints positions; ///< (n,3) [m]
  Triangles triangles;   ///< (m,3)
};

/// The faults of a cloth. Numbers: no triangle, no rest coordinates, indices out of range,
/// coordinates that are not finite, a rest vertex that stands for two vertices in space. At rest:
/// triangles without area (twice the area at most 1e-9 of the square of the longest edge), mirrored
/// panels, flipped triangles. In space: duplicate triangles, edges with more than two triangles,
/// neighbours that run along an edge the same way. T-junctions: a vertex on the outline of a panel
/// that lies inside (to 1e-4 of its length) an edge of that outline, and the same in space where
/// the two are open and have a vertex in common; of one panel, which may lie folded on itself, only
/// where the sides of a dart were meant to be sewn. Vertices that no triangle uses. At most three
/// messages per kind.
/// @param name put before each message, usually the file
std::vector<std::string> cloth_faults(const ClothMesh &cloth, const std::string &name);

/// The faults of a closed surface: the numbers, triangles without area, open edges, edges with more
/// than two triangles, inconsistent winding, a surface that is inside out, unused vertices.
std::vector<std::string> surface_faults(const Surface &surface, const std::string &name);
} // namespace homespun::meshes
