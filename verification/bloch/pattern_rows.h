// SPDX-License-Identifier: MIT
// The patterns of a path, as rows.
#pragma once

#include "verification/bloch/mesh_of_cell.h"
#include "verification/bloch/pattern_tables.h"
#include "verification/bloch/stability_tables.h"
#include "verification/reference/loads.h"

#include <optional>
#include <vector>

namespace homespun::verification
{
/// Follows the lowest wave at each level that is lost.
/// @param levels of one path, on this mesh
/// @param cells that are solved as one; nothing: those over which the lowest wave of a level
///   repeats, where that is finite
std::vector<PatternRow> patterns_of(const MeshOfCell &mesh, const Load &load,
                                    const std::vector<StabilityRow> &levels,
                                    const std::optional<Eigen::Vector2i> &cells);
} // namespace homespun::verification
