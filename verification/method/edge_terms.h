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
#include "verification/method/lightweight_cloth.h"
#include "verification/reference/laws.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A homogenized cell and what it does at edges.
struct CellWithEdges
{
  const meshes::HomogenizedCell &cell;
  const meshes::CellEdges &edges;
  /// Modes under a law; slip and layers of clamped edges follow their effective strain, layers of
  /// free ones meshes::strain_of_free_edges(), tension and forces within the strain itself. Null:
  /// all do.
  const meshes::FittedModes *fitted = nullptr;
};

class EdgeTerms
{
public:
  using Positions = localization::Positions<2>;

  /// @param edges of the cell, whose fields stand at the vertices of its mesh
  /// @param sheet of that cell; all three are to be kept by the caller
  /// @param load of a sheet: edges that it holds are clamped, the others free
  /// @throws BadInput where the load is one of an infinite cloth
  EdgeTerms(const CellWithEdges &cell, const meshes::Sheet &sheet, const Load &load,
            CoarseGrid grid, Law law);

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

/// The vertices of a coarse mesh that a load holds; none of an infinite cloth.
std::vector<int> held_by(const Load &load, const meshes::Sheet &sheet,
                         const meshes::TriangleMesh &mesh);

/// The coarse cloth with the terms of edges: u0 + u1. In linear theory one more substitution with
/// the factored stiffness; under other laws the equilibrium under the same forces, from u0.
/// @param terms on the grid of the space
/// @param solver of the nodes of the space, the held ones on clamped edges
/// @param positions of the nodes in equilibrium without the terms (n,2) [m]
/// @throws NotConverged
shell::Equilibrium<2> with_edges(const EdgeTerms &terms, const CoarseSpace &space,
                                 const CoarseSolver &solver, const EdgeTerms::Positions &positions);

/// Whether a method of this name has a meaning under a load: an infinite cloth has no edges,
/// and the motion of its coarse cloth is given.
bool has_meaning(const Method &method, const Load &load);
bool has_meaning(const Method &method, Law law, const Load &load);

/// What a sheet with terms of edges is up-sampled to; `seconds` holds both.
struct EdgedPositions : UpsampledSheet
{
  double seconds_of_terms = 0.; ///< of the coarse cloth with the terms
  int steps_of_terms      = 0;  ///< Newton steps of that
};

/// The methods `edges` and `full` on a sheet: chi with mean zero, the terms of edges in coarse and
/// in fine positions. It keeps a factored stiffness of its own.
class EdgedSheet
{
public:
  /// @throws BadInput as EdgeTerms
  /// @param method of edges, with what else it asks for
  /// @param quads_per_cell of the coarse mesh, along either side: 1 is the sheet's own lattice
  EdgedSheet(const CellWithEdges &cell, const meshes::Sheet &sheet, const Load &load,
             const Method &method = Method("edges"), int quads_per_cell = 1);

  /// @param coarse_positions of the nodes in equilibrium without the terms (n,2) [m]
  /// @param fitted the cell's modes under that law, where the method has fitted ones
  /// @throws NotConverged; BadInput where the cell has no cubic energy under the law
  EdgedPositions upsample(Law law, const EdgeTerms::Positions &coarse_positions,
                          const meshes::FittedModes *fitted = nullptr) const;

  /// Which of the four edges have which terms.
  std::string sentence() const;

private:
  const CellWithEdges cell;
  const meshes::Sheet &sheet;
  const Load load;
  const Method method;
  const CoarseSpace space;
  /// By the law of a cubic energy; without one under no name.
  std::map<std::string, std::unique_ptr<CoarseSolver>> solvers;
};
} // namespace homespun::verification
