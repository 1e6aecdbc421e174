// SPDX-License-Identifier: MIT
// The lattice of a cell that names none: that of the frame in which it is drawn.
#pragma once

#include "homogenization/lint/side_matching.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// Matches the sides of a cell by the lattice of the first frame around the drawing that fits: each
/// pair of its sides has edges that are images, and the rest of the outline is rims. Where none
/// does, the faults say of which lattices the outline as a whole would be.
MatchedCell match_drawn_sides(const meshes::TriangleMesh &mesh,
                              const std::vector<CurvedSide> &curved_sides, const SideRules &rules,
                              const std::string &name);

/// The same, or by the lattice that is given. Where a wider `Matching tolerance` is all that the
/// sides need, the first fault says which.
MatchedCell match_given_or_drawn_sides(const meshes::TriangleMesh &mesh,
                                       const std::vector<CurvedSide> &curved_sides,
                                       const std::optional<meshes::Lattice> &given,
                                       const SideRules &rules, const std::string &name);

/// `set Lattice vectors = ...`, the line of a cell file.
std::string lattice_line(const meshes::Lattice &lattice, double metres_per_unit);
} // namespace homespun::homogenization
