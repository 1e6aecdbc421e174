// SPDX-License-Identifier: MIT
// The lattice of a cell whose outline is no parallelogram: hexagons with three pairs of sides, wavy
// or toothed sides.
#pragma once

#include "meshes/plain/lattice.h"

#include <optional>
#include <vector>

namespace homespun::meshes
{
/// Translations that carry a piece of the outline onto another one are tried in pairs, the shortest
/// first, until two span the enclosed area and match every vertex of the outline: a1 nearest to the
/// x axis, a1 x a2 > 0.
/// @return nothing where there is no such pair
std::optional<Lattice> lattice_by_matching(const TriangleMesh &mesh);

/// Lattices that a mesh may have whose outline cuts holes, the likeliest first: pairs of the
/// translations that carry the greatest lengths of its boundary onto other pieces of it, and that
/// span no less than its triangles cover. Which of them is right the caller has to find out.
std::vector<Lattice> lattices_by_length(const TriangleMesh &mesh);
} // namespace homespun::meshes
