// SPDX-License-Identifier: MIT
// How much of an error is the constant of chi, which only the place decides where the cell is cut
// from the cloth: the same cloth cut elsewhere has chi zero at another vertex.
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "verification/law/laws.h"

#include <string>

namespace homespun::verification
{
/// Mean errors of `localized` over the fine vertices with chi zero at other vertices of the cell
/// [m].
struct AnchorChoice
{
  double smallest = 0., largest = 0.;
};

/// Up-samples one coarse solution with chi zero at the vertices nearest to a grid of 4 x 4 points
/// of the cell.
/// @param coarse the coarse mesh, @param positions its vertices in equilibrium [m]
/// @param reference (n,2) the resolved sheet [m]
AnchorChoice errors_of_other_anchors(const meshes::HomogenizedCell &cell,
                                     const meshes::TriangleMesh &coarse, const meshes::Sheet &sheet,
                                     Law law, const meshes::Points &positions,
                                     const meshes::Points &reference);

/// A sentence on what the place of the cut decides; empty where that is not more than the
/// reference's error bar.
/// @param localized, affine mean errors as the cell is cut [m] @param bar of the reference [m]
std::string note_of_anchor(const AnchorChoice &choice, double localized, double affine, double bar);
} // namespace homespun::verification
