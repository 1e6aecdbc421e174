// SPDX-License-Identifier: MIT
#include "verification/strain/budget/edge_parts.h"

namespace homespun::verification
{
using meshes::CellEdge;
using meshes::CellEdges;
using meshes::Points;

std::array<CellEdges, 4> edges_piece_by_piece(const CellEdges &edges)
{
  CellEdges without_modes = edges;
  for (CellEdge &side : without_modes.sides)
  {
    side.clamped.setZero();
    side.free.setZero();
  }
  CellEdges without_bulk = without_modes;
  for (Eigen::Matrix3d &of_axis : without_bulk.bulk)
    of_axis.setZero();
  CellEdges slip_alone = without_bulk;
  for (CellEdge &side : slip_alone.sides)
    side.tension.setZero();
  return {slip_alone, without_bulk, without_modes, edges};
}

EdgeParts edge_parts(const CoarseModel &resolved, const Load &load,
                     const std::array<CellEdges, 4> &pieces, const CoarseState &u,
                     const Points &localized)
{
  const CoarseSpace &space = resolved.parts.space;
  std::array<Points, 4> solutions;
  CoarseState moved;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const CellModel of_pieces = {resolved.cell.cell, &pieces[k]};
    const EdgeTerms<2> terms(of_pieces, resolved.sheet, space, edge_kinds(load), resolved.law);
    if (k < 3) // modes move no coarse vertex
      moved = resolved.with_edges(terms, u);
    localization::Upsampler<2, double>::Fine fine;
    localization::Upsampler<2, double>(
      resolved.cell.cell, space.grid.mesh, resolved.sheet,
      options_of(Method("localized+edges"), resolved.law, of_pieces, edge_kinds(load)))
      .upsample(moved.positions, fine);
    solutions[k] = fine;
  }
  return {localized - solutions[0], solutions[0] - solutions[1], solutions[1] - solutions[2],
          solutions[2] - solutions[3]};
}
} // namespace homespun::verification
