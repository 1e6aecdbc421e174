// SPDX-License-Identifier: MIT
// The infinite cloths that are studied: a cell with its phases, and one stiffness in place of it.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/periodic_cell/cell_assembly.h"

#include <Eigen/Core>

namespace homespun::verification
{
/// A cell on its given mesh, refined so often, under a law.
CellAssembly resolved_cloth(const homogenization::UnitCell &cell, int n_refinements, Law law);

/// A cloth without a microstructure, on a parallelogram of two triangles.
/// @param stiffness (3,3) [N/m]
CellAssembly uniform_cloth(const meshes::Lattice &lattice, const Eigen::Matrix3d &stiffness,
                           Law law);
} // namespace homespun::verification
