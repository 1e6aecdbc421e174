// SPDX-License-Identifier: MIT
// The modes that decay from the edges of a panel inwards, vertex by vertex: there w is
// w_a + phi_a − d_a (clamped) or w_a + phi_a (free) in the place of w_a, linear in the strain as
// before (meshes::CellEdges). So they change constants of the vertices near edges and cost a frame
// nothing but the memory of these. Private to upsampler and placed_garment.
//
// Where an edge on a lattice line ends at a seam, at another outline or in a corner that is not
// convex, its modes fade, as w does at seams: beyond the end they would belong to no edge. An
// outline in their way ends them. In a convex corner the modes of two edges add up.
#pragma once

#include "localization/cell_modes.h"
#include "localization/options.h"
#include "localization/panel_edges.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <string>
#include <vector>

namespace homespun::localization
{
/// How the slip L d E of clamped edges moves a coarse mesh: it is taken at the vertices of the
/// edges, with their strain and rotation, and carried into their panel.
struct EdgeSlip
{
  struct Source
  {
    int vertex;                    ///< of the coarse mesh
    Eigen::Matrix<double, 2, 3> d; ///< of its edge [m]
  };
  std::vector<Source> sources;                             ///< none: there is no slip
  Eigen::SparseMatrix<double, Eigen::RowMajor> of_sources; ///< (n_coarse, sources); rows add to 1

  /// L d E of each source [m].
  /// @param records of the coarse vertices, `size` numbers each: position, E, L row by row
  template <int dim, typename Scalar>
  void evaluate(const Scalar *const records, const int size, Positions<dim> &moves) const
  {
    moves.resize(static_cast<Eigen::Index>(sources.size()), dim);
    for (std::size_t k = 0; k < sources.size(); ++k)
    {
      const Scalar *const E = records + sources[k].vertex * size + dim;
      const Eigen::Map<const Eigen::Matrix<Scalar, dim, 2, Eigen::RowMajor>> L(E + 3);
      const Eigen::Vector2d along             = sources[k].d * Eigen::Vector3d(E[0], E[1], E[2]);
      moves.row(static_cast<Eigen::Index>(k)) = (L.template cast<double>() * along).transpose();
    }
  }
};

class EdgeModes
{
public:
  using Row = Eigen::Matrix<double, 1, 6>;

  /// @param options whose edges are taken, none or those of the cell; read here alone
  EdgeModes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options);

  bool are_there() const
  {
    return edges != nullptr;
  }

  /// What the modes of all edges add to w at a fine vertex, per unit strain, column 2 a + c [m].
  Row at(const Panel &panel, const PanelPoint &place) const
  {
    return at(panel, place, EdgeKind::clamped) + at(panel, place, EdgeKind::free);
  }

  /// Modes of a fine vertex, as VertexTable::append() takes them.
  /// @param of_cell those of the cell
  ModesRow added_to(const ModesRow &of_cell, const Panel &panel, const PanelPoint &place) const;

  /// The slip of a coarse mesh, with that of each clamped edge where a vertex stands opposite it,
  /// weighted by one over the distance from it in parts of the panel: a single clamped edge takes
  /// the panel along, and between two that face each other slip is linear, as where the panel is
  /// strained evenly. Panels without clamped edges have none.
  EdgeSlip slip_of(const std::vector<Panel> &panels, const meshes::TriangleMesh &coarse) const;

  /// How far a cell of a sheet is from each edge that reaches it, in cells; −1: it does not. The
  /// vertices of cells for which this is alike have the same modes.
  std::vector<int> depths(const Panel &sheet, int i, int j) const;

private:
  Row at(const Panel &panel, const PanelPoint &place, EdgeKind kind) const;
  double part_at(const Panel &panel, const PanelEdge &edge, const PanelPoint &place) const;
  int reached(const PanelEdge &edge, int of_cell) const;

  const meshes::HomogenizedCell &cell;
  const meshes::CellEdges *edges;
  EdgeKinds kinds;
  double fade;            ///< at ends of edges [cells]
  bool free_are_apart;    ///< in columns of their own
  meshes::Points in_cell; ///< of the cell's vertices
  /// By axis: of each vertex of the cell that lies at an end of the axis, its image at the other.
  std::array<std::vector<int>, 2> across;
};

/// Grows from 0 at 0 to 1 at 1, with slope zero at both.
double smooth_step(double s);

/// What hinders options with edges: chi without mean zero, modes of another mesh.
std::vector<std::string> edge_faults(const meshes::HomogenizedCell &cell,
                                     const UpsamplerOptions &options);
} // namespace homespun::localization
