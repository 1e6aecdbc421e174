// SPDX-License-Identifier: MIT
// What a homogenized sheet lacks at its edges, piece by piece: the terms of edge_terms.h taken in
// one after the other, each step a difference of two solutions of the resolved sheet.
//
//   S0  u + R w(E), chi anchored at the lattice: what localization makes of the resolved sheet
//   S1  the same with slip of the clamped edges in u, and chi with mean zero
//   S2  and tension of the free edges
//   S3  and the force of strain gradients
//   S4  and the modes that decay from the edges
//
//   slip = S0 − S1,  selvedge = S1 − S2,  bulk = S2 − S3,  layer = S3 − S4
//
// The anchor stands in slip: a chi that is shifted by a constant shifts the slip that belongs to it
// by the same, and neither does without the other. S1 to S4 do not depend on the constant.
#pragma once

#include "meshes/plain/cell_edges.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "verification/method/coarse_model.h"

#include <array>

namespace homespun::verification
{
/// Fields at the fine vertices (n,2) [m].
struct EdgeParts
{
  meshes::Points slip, selvedge, bulk, layer;
};

/// The four pieces of a cell's edges that are taken in: each has those before it, too.
/// @return slip alone; and tension; and bulk; and modes
std::array<meshes::CellEdges, 4> edges_piece_by_piece(const meshes::CellEdges &edges);

/// @param resolved homogenized sheet without the terms
/// @param load of that sheet, not of an infinite cloth
/// @param pieces edges_piece_by_piece() of its cell
/// @param u its equilibrium
/// @param localized S0
/// @throws NotConverged
EdgeParts edge_parts(const CoarseModel &resolved, const Load &load,
                     const std::array<meshes::CellEdges, 4> &pieces, const CoarseState &u,
                     const meshes::Points &localized);
} // namespace homespun::verification
