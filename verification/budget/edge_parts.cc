// SPDX-License-Identifier: MIT
#include "verification/budget/edge_parts.h"

#include "localization/upsampler.h"
#include "verification/method/method.h"

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

EdgePartsOfSheet::EdgePartsOfSheet(const meshes::HomogenizedCell &cell, const CellEdges &edges,
                                   const meshes::Sheet &sheet, const Load &load,
                                   const int refinement)
    : cell(cell)
    , sheet(sheet)
    , load(load)
    , pieces(edges_piece_by_piece(edges))
    , space(sheet, CoarseElement::three_nodes, refinement)
    , solver(space.solver(cell.stiffness, held_vertices(load, sheet, space.nodes.mesh.vertices)))
{
}

EdgeParts EdgePartsOfSheet::measure(const Law law, const shell::Positions<2> &u,
                                    const Points &localized) const
{
  std::array<Points, 4> solutions;
  shell::Positions<2> moved;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const EdgeTerms terms({cell, &pieces[k]}, sheet, load, space.grid, law);
    if (k < 3) // modes move no coarse vertex
      moved = with_edges(terms, space, *solver, u).positions;
    localization::UpsamplerOptions options = Method("localized+edges").options(law);
    terms.give_edges(options);
    localization::Upsampler<2, double>::Fine fine;
    localization::Upsampler<2, double>(cell, space.grid.mesh, sheet, options).upsample(moved, fine);
    solutions[k] = fine;
  }
  return {localized - solutions[0], solutions[0] - solutions[1], solutions[1] - solutions[2],
          solutions[2] - solutions[3]};
}
} // namespace homespun::verification
