// SPDX-License-Identifier: MIT
// What a cell adds to the homogenized deflection of its sheet, vertex by vertex.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/bend/bending_cell.h"
#include "verification/bend/plate_sheet.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::verification
{
enum class Micro
{
  none,
  cell, ///< w3 = K_a w_a
  edges ///< and K_a times the layers at its clamped and free edges (edges/plate_edges.h)
};

class MicroDeflection
{
public:
  /// All three are kept by reference.
  MicroDeflection(const BendingCell &cell, const BendingLoad &load, const meshes::Sheet &sheet);

  /// w, w,1, w,2 at a vertex of the sheet; the layers are left out where they are not known.
  /// @param curvature K of the homogenized sheet there, 11, 22, 2 K12 [1/m]
  Eigen::Vector3d deflection(Micro micro, int vertex, const Eigen::Vector3d &curvature) const;

private:
  Eigen::Vector3d layers_at(int vertex, const Eigen::Vector3d &curvature) const;

  const BendingCell &cell;
  const BendingLoad &load;
  const meshes::Sheet &sheet;
  /// By axis and end, near and far: of each vertex of the glued cell one of the drawn cell that
  /// lies there, or −1.
  std::array<std::array<std::vector<int>, 2>, 2> on_end;
};
} // namespace homespun::verification
