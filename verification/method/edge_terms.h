// SPDX-License-Identifier: MIT
// What edges add to a homogenized sheet of whole cells, to first order in the cell: slip of its
// clamped edges, tension of its free ones, the force of strain gradients within, and the modes that
// decay from an edge inwards (homogenization/edges/edge_layers.h has the equations).
#pragma once

#include "localization/coarse_frames.h"
#include "meshes/plain/cell_edges.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "verification/method/coarse_space.h"
#include "verification/reference/laws.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What is known of a cell, as far as a method asks for it.
struct CellModel
{
  const meshes::HomogenizedCell &cell;
  const meshes::CellEdges *edges = nullptr; ///< what it does at edges
  /// Modes under a law; slip and layers of clamped edges follow their effective strain, layers of
  /// free ones meshes::strain_of_free_edges(), tension and forces within the strain itself. Null:
  /// all do.
  const meshes::FittedModes *fitted = nullptr;
};

class EdgeTerms
{
public:
  using Positions = localization::Positions<2>;

  /// @param cell with edges, whose fields stand at the vertices of its mesh
  /// @param sheet of that cell; all are to be kept by the caller
  /// @param load of a sheet: edges that it holds are clamped, the others free
  /// @throws BadInput where the load is one of an infinite cloth
  EdgeTerms(const CellModel &cell, const meshes::Sheet &sheet, const Load &load, CoarseGrid grid,
            Law law);

  /// The right-hand side of the macro problem of the order of the cell.
  struct MacroLoads
  {
    Positions slip;   ///< d_a E_a at the vertices of clamped edges, elsewhere zero (n,2) [m]
    Positions forces; ///< on the vertices (n,2) [N]
  };

  /// @param positions of the coarse vertices without the terms (n,2) [m]
  MacroLoads macro_loads(const Positions &positions) const;

  /// Gives up-sampling the edges of the cell, with what each is.
  void give_edges(localization::UpsamplerOptions &options) const;

  const CoarseGrid grid;
  const Law law;

private:
  void add_side(int side, const Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> &frames,
                MacroLoads &loads) const;

  const meshes::CellEdges &edges;
  const meshes::FittedModes *const fitted;
  const meshes::Sheet &sheet;
  const localization::CoarseFrames<2> frames;
  std::array<bool, meshes::CellEdges::n_sides> is_clamped;
};

/// The coarse cloth with the terms of edges: u0 + u1. In linear theory one more substitution with
/// the factored stiffness; under other laws the equilibrium under the same forces, from u0.
/// @param terms on the grid of the space
/// @param solver of the nodes of the space, the held ones on clamped edges
/// @param positions of the nodes in equilibrium without the terms (n,2) [m]
/// @throws NotConverged
shell::Equilibrium<2> with_edges(const EdgeTerms &terms, const CoarseSpace &space,
                                 const CoarseSolver &solver, const EdgeTerms::Positions &positions);

/// Which of the four edges of a sheet have which terms.
std::string sentence_of_edges(const meshes::CellEdges &edges, const Load &load);
} // namespace homespun::verification
