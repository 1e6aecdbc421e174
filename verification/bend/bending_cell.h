// SPDX-License-Identifier: MIT
// A cell as it bends.
#pragma once

#include "homogenization/bracket/plate.h"
#include "homogenization/cell/unit_cell.h"
#include "homogenization/edges/plate_edges.h"
#include "verification/cell/cell_edges.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::verification
{
/// w_a and D^H of a cell, and the edges of its plate or why they are not known.
struct BendingCell
{
  /// @param cell kept by reference
  explicit BendingCell(const homogenization::UnitCell &cell);

  /// Whether its deflections are zero to round-off.
  bool is_of_one_material() const;

  const homogenization::UnitCell &cell;
  std::vector<Eigen::Matrix3d> bending_stiffness_of_phase;
  homogenization::TorusMesh torus;
  homogenization::PlateCell solved;
  KnownPlateEdges known; ///< its edges
};
} // namespace homespun::verification
