// SPDX-License-Identifier: MIT
// What edges add to a homogenized sheet of whole cells, at rest and in motion, to first order in
// the cell: slip of its clamped edges, tension of its free ones, the force of strain gradients
// within, and the modes that decay from an edge inwards (homogenization/edges/edge_layers.h has the
// equations). At rest tension is a load on the coarse vertices; in motion it is a term of the cloth
// (shell/terms/selvedge.h), and slip and gradients are those where a step begins, so that they lag
// by a step.
#pragma once

#include "localization/coarse_frames.h"
#include "localization/method.h"
#include "meshes/plain/cell_edges.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "shell/terms/selvedge.h"
#include "verification/method/coarse_space.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
using localization::CellModel;
using localization::EdgeKinds;

/// Edges that a load holds are clamped, the others free.
/// @throws BadInput where the load is one of an infinite cloth
EdgeKinds edge_kinds(const Load &load);

/// An edge all of whose nodes are held is clamped, one with none held between its ends is free,
/// another has no terms.
/// @param quads between the nodes
EdgeKinds edge_kinds(Quads quads, const std::vector<int> &held);

/// @tparam dim 2 of a sheet at rest in its plane, 3 of one that moves in space
template <int dim>
class EdgeTerms
{
public:
  using Positions = localization::Positions<dim>;

  /// @param cell with edges, whose fields stand at the vertices of its mesh
  /// @param sheet of that cell; all are to be kept by the caller
  /// @param space in which its coarse cloth moves
  /// @throws BadInput where, in motion, a free edge pushes harder than the triangles behind it bear
  EdgeTerms(const CellModel &cell, const meshes::Sheet &sheet, const CoarseSpace &space,
            const EdgeKinds &kinds, Law law);

  /// d_a E_a, lifted, of the nodes on clamped edges, elsewhere zero.
  /// @param positions of the nodes (n,dim) [m]
  /// @return (n,dim) [m]
  Positions slip(const Positions &positions) const;

  /// Forces of strain gradients on the nodes, and at rest those of tension (n,dim) [N].
  Positions forces(const Positions &positions) const;

  /// Whether strain gradients have forces: not where the cell has a centre of symmetry.
  bool has_bulk_forces() const;

  /// In motion, cables on the free edges.
  const std::vector<shell::SelvedgeSegment> &selvedges() const
  {
    return segments;
  }

  const Law law;

private:
  using Values = typename localization::CoarseFrames<dim>::Values;
  template <typename Function>
  void for_each(localization::EdgeKind kind, const Function &function) const;
  void add_tension(int side, const meshes::CellEdge &edge, const Values &frames,
                   Positions &forces_of_grid) const;
  void add_cables(int side, const meshes::CellEdge &edge);

  const meshes::HomogenizedCell &cell;
  const meshes::CellEdges &edges;
  const meshes::FittedModes *const fitted;
  const meshes::Sheet &sheet;
  const CoarseSpace space;
  const localization::CoarseFrames<dim> frames; ///< of its grid
  const EdgeKinds kinds;
  std::vector<shell::SelvedgeSegment> segments;
};

/// Which of the four edges of a sheet have which terms.
std::string sentence_of_edges(const EdgeKinds &kinds);
} // namespace homespun::verification
