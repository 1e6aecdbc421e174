// SPDX-License-Identifier: MIT
// Cells whose outline cuts holes. The cloth is the same wherever a period of it is cut out: where
// two straight lines along the lattice vectors meet no hole, the cell is cut anew along them, with
// its holes inside. Nothing but the place of the cut changes; C^H does not depend on it.
#pragma once

#include "homogenization/cell/curved_sides.h"
#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// From the lower left corner of the cell as it is drawn to that of the cell that is used.
struct CellShift
{
  Eigen::RowVector2d parts;  ///< of the lattice vectors a1 and a2, 0 to 1
  Eigen::RowVector2d metres; ///< parts * lattice.vectors
};

/// What was done, by how much, in a sentence for every result.
std::string sentence_of(const CellShift &shift);

/// What comes of a cell whose outline cuts holes: the cell cut anew, or why there is none.
struct CellCutAnew
{
  std::optional<CellShift> shift; ///< nothing where `obstacle` says why
  meshes::TriangleMesh mesh;      ///< counter-clockwise, materials as they were [m]
  std::vector<CurvedSide> curved_sides;
  std::string obstacle; ///< of the form `what; expected ...`, with the holes that are in the way
};

/// Cuts a cell anew whose outline cuts holes. Lines are sought where no hole is; of these the one
/// that leaves the best triangles, in its place as drawn where no hole is cut there.
/// @param mesh whose sides match but for holes, as of match_sides() [m]
/// @param group (n_triangles) triangles of one group may exchange area; mostly their material
CellCutAnew cut_anew(const meshes::TriangleMesh &mesh, const Eigen::VectorXi &group,
                     const std::vector<CurvedSide> &curved_sides, const meshes::Lattice &lattice);
} // namespace homespun::homogenization
