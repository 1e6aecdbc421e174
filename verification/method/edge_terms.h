// SPDX-License-Identifier: MIT
// What edges add to a homogenized sheet of whole cells, to first order in the cell: slip of its
// clamped edges, tension of its free ones, the force of strain gradients within, and the modes that
// decay from an edge inwards (homogenization/edges/edge_layers.h has the equations).
#pragma once

#include "localization/coarse_frames.h"
#include "meshes/plain/cell_edges.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "verification/method/lightweight_cloth.h"
#include "verification/method/sheet_solvers.h"
#include "verification/reference/laws.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A mesh of meshes::coarse_sheet() that covers a sheet.
struct CoarseGrid
{
  meshes::TriangleMesh mesh;
  int n1, n2; ///< quads along either side of the sheet
};

/// A homogenized cell and what it does at edges.
struct CellWithEdges
{
  const meshes::HomogenizedCell &cell;
  const meshes::CellEdges &edges;
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

  /// Adds (phi_a − d_a) E_a or phi_a E_a, lifted, to fine positions near edges.
  /// @param positions of the coarse vertices with the terms (n,2) [m]
  /// @param fine (n_fine,2) [m]
  void add_modes(const Positions &positions, meshes::Points &fine) const;

  const CoarseGrid grid;
  const Law law;

private:
  /// A fine vertex near an edge.
  struct Member
  {
    int vertex, triangle;
    Eigen::Vector3d weights;
    const meshes::EdgeModes *modes;
    Eigen::Index row;
  };

  void add_bulk_forces(const Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> &frames,
                       Positions &forces) const;
  void add_side(int side, const Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> &frames,
                MacroLoads &loads) const;
  void find_members(int side);

  const meshes::HomogenizedCell &cell;
  const meshes::CellEdges &edges;
  const meshes::Sheet &sheet;
  const localization::CoarseFrames<2> frames;
  std::array<bool, meshes::CellEdges::n_sides> is_clamped;
  std::vector<Member> members;
};

/// Coarse positions with the terms of edges: u0 + u1. In linear theory one more substitution with
/// the factored stiffness; under other laws the equilibrium under the same forces, from u0.
/// @param solver of the same coarse mesh and the same held vertices
/// @param positions in equilibrium without the terms (n,2) [m]
/// @throws NotConverged
EdgeTerms::Positions with_edges(const EdgeTerms &terms, const shell::MembraneSolver<2> &solver,
                                const EdgeTerms::Positions &positions);

/// Whether a method of this name has a meaning under a load: an infinite cloth has no edges.
bool has_meaning(const Method &method, Law law, const Load &load);

/// The method `edges` on a sheet: chi with mean zero, the terms of edges in coarse and in fine
/// positions. It keeps a factored stiffness of its own.
class EdgedSheet
{
public:
  /// @throws BadInput as EdgeTerms
  /// @param quads_per_cell of the coarse mesh, along either side: 1 is the sheet's own lattice
  EdgedSheet(const CellWithEdges &cell, const meshes::Sheet &sheet, const Load &load,
             int quads_per_cell = 1);

  /// @param coarse_positions in equilibrium without the terms (n,2) [m]
  /// @return seconds with those of the terms
  /// @throws NotConverged
  UpsampledSheet upsample(Law law, const EdgeTerms::Positions &coarse_positions) const;

  /// Which of the four edges have which terms.
  std::string sentence() const;

private:
  const CellWithEdges cell;
  const meshes::Sheet &sheet;
  const Load load;
  const CoarseGrid coarse;
  const SheetSolvers solvers;
};
} // namespace homespun::verification
