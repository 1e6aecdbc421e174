// SPDX-License-Identifier: MIT
// What hurts later in a cell that can be read: shapes, units, contrast, thin parts,
// mechanisms. Each finding says what, where and what to do; none of them needs a solution.
#pragma once

#include "homogenization/cell/finding.h"
#include "homogenization/cell/unit_cell.h"

#include <vector>

namespace homespun::homogenization
{
/// Slivers: needs a mesh alone.
/// @param metres_per_unit of the mesh file, for places in its own unit
std::vector<Finding> lint_slivers(const meshes::TriangleMesh &mesh, double metres_per_unit);

/// Parts that move without energy, and hinges: needs a lattice that fits.
std::vector<Finding> lint_mechanisms(const meshes::TriangleMesh &mesh,
                                     const meshes::Lattice &lattice, double metres_per_unit);

/// A cell of a size that no cloth has, most often millimetres taken for metres.
/// @param side of the cell [m]
std::vector<Finding> lint_size(double side, double metres_per_unit);

/// Thickness, stiffness and mass that no fabric has.
/// @param side of the cell [m]
std::vector<Finding> lint_phases(const UnitCell &cell, double side);

/// Borders of phases that meet a side of the cell where its image has none: the repeated cloth has
/// a phase that ends there.
std::vector<Finding> lint_continuity(const UnitCell &cell, double metres_per_unit);

/// Contrast beyond double precision: an error where no digit is left.
std::vector<Finding> lint_contrast(const UnitCell &cell);

/// Outlines that turn by small equal angles, polygons in the place of arcs: needs a mesh with
/// phases, and a lattice that fits.
std::vector<Finding> lint_facets(const UnitCell &cell, double metres_per_unit);

/// Phases with a single element across: needs a mesh with phases, and a lattice that fits.
std::vector<Finding> lint_thin_parts(const UnitCell &cell, double metres_per_unit);
} // namespace homespun::homogenization
