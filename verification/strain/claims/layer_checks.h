// SPDX-License-Identifier: MIT
// The layers at the edges of a sheet by what they are for: on a clamped edge the up-sampled sheet
// is where it is held, vertex by vertex, and on a free edge nothing pulls at its vertices. Both
// hold to first order in the cell: what layers leave, over what there is without them, is of
// order 1 in cell side over sheet side.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "shell/membrane/membrane.h"
#include "verification/method/coarse_model.h"
#include "verification/record/verdict.h"

#include <array>
#include <vector>

namespace homespun::verification
{
/// Of the vertices of a clamped edge the distance from where they are held [m], of those of a free
/// one the force that pulls at them [N].
struct EdgeResidual
{
  double mean = 0., largest = 0.;
};
using EdgeResiduals = std::array<EdgeResidual, meshes::CellEdges::n_sides>;

/// A sheet under a load in linear theory, up-sampled by `full`.
class LayeredSheet
{
public:
  /// @param cell, model to be kept by the caller, the latter with its edges
  /// @param n_quads of the coarse mesh along a cell
  /// @throws NotConverged
  LayeredSheet(const homogenization::UnitCell &cell, const CellModel &model, const Load &load,
               int n_cells, int n_quads);

  /// What the layers of given edges leave.
  /// @param apart from both ends of an edge, as a part of it: vertices that are nearer are left out
  EdgeResiduals left_by(const meshes::CellEdges &edges, double apart) const;

private:
  const CellModel of_cell;
  const Load load;
  const meshes::Sheet sheet;
  const CoarseModel model;
  const meshes::Points coarse;
  const shell::Membrane membrane;
};

/// The same edges without layers: their slip and tension.
meshes::CellEdges without_layers(const meshes::CellEdges &edges);

/// Two claims: in the middle half of clamped edges, and of free ones, layers leave less than there
/// is without them, on sheets of 8 x 8 cells under both strips, the worst of the edges that
/// have layers and whose error without them is more than rounding. Where they leave more, 16 x 16
/// cells are asked. Then an edge is not judged where what there is without layers is not of order 0
/// in the cell, as of stripes along it, nor what they leave: there is nothing to remove; FAIL where
/// what layers leave is of order 0, too, and open where that falls, or where C^H is so anisotropic
/// that the homogenized strain varies over less than a cell of that sheet. A layer that is half as
/// large as it should be passes: the order of what layers leave, which it changes, takes many more
/// cells. None where no edge is judged.
std::vector<Verdict> layer_checks(const homogenization::UnitCell &cell, const CellModel &model);
} // namespace homespun::verification
