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
#include "verification/method/coarse_space.h"
#include "verification/method/edge_terms.h"
#include "verification/reference/laws.h"
#include "verification/reference/loads.h"

#include <array>
#include <memory>

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

class EdgePartsOfSheet
{
public:
  /// @param cell, sheet to be kept by the caller
  /// @param load of a sheet, not of an infinite cloth
  /// @param refinement quads of the resolved sheet along a side of a cell
  EdgePartsOfSheet(const meshes::HomogenizedCell &cell, const meshes::CellEdges &edges,
                   const meshes::Sheet &sheet, const Load &load, int refinement);

  /// @param u the resolved sheet in equilibrium without the terms (n,2) [m]
  /// @param localized S0
  /// @throws NotConverged
  EdgeParts measure(Law law, const shell::Positions<2> &u, const meshes::Points &localized) const;

private:
  const meshes::HomogenizedCell &cell;
  const meshes::Sheet &sheet;
  const Load load;
  const std::array<meshes::CellEdges, 4> pieces;
  const CoarseSpace space;
  const std::unique_ptr<CoarseSolver> solver;
};
} // namespace homespun::verification
