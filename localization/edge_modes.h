// SPDX-License-Identifier: MIT
// The modes that decay from the edges of a sheet inwards, vertex by vertex: there w is
// w_a + phi_a − d_a (clamped) or w_a + phi_a (free) in the place of w_a, linear in the strain as
// before (meshes::CellEdges). So they change constants of the vertices near edges and cost a frame
// nothing but the memory of these. Private to upsampler.
#pragma once

#include "localization/options.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <string>
#include <vector>

namespace homespun::localization
{
/// How the slip L d E of clamped edges moves a coarse mesh: it is taken at the vertices of the
/// edges, with their strain and rotation, and carried into the sheet.
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
  EdgeModes(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet,
            const UpsamplerOptions &options);

  bool are_there() const
  {
    return edges != nullptr;
  }

  /// What the modes of edges of a kind add to w at a fine vertex, per unit strain, column 2 a + c
  /// [m].
  Row at(int vertex, EdgeKind kind) const;

  /// The same of all edges.
  Row at(const int vertex) const
  {
    return at(vertex, EdgeKind::clamped) + at(vertex, EdgeKind::free);
  }

  /// The slip of a coarse mesh, with that of each clamped edge where a vertex stands opposite it,
  /// weighted by one over the distance from it in parts of the sheet: a single clamped edge takes
  /// the sheet along, and between two that face each other slip is linear, as where the sheet is
  /// strained evenly.
  EdgeSlip slip_of(const meshes::TriangleMesh &coarse) const;

  /// How far a cell of the sheet is from each edge that reaches it, in cells; −1: it does not. The
  /// vertices of cells for which this is alike have the same modes.
  using Depths = std::array<int, meshes::CellEdges::n_sides>;
  Depths depths(int i, int j) const;

private:
  const meshes::HomogenizedCell &cell;
  const meshes::Sheet &sheet;
  const meshes::CellEdges *edges;
  EdgeKinds kinds;
  /// By axis: of each vertex of the cell that lies at an end of the axis, its image at the other.
  std::array<std::vector<int>, 2> across;
};

/// What hinders options with edges: chi without mean zero, modes of another mesh.
std::vector<std::string> edge_faults(const meshes::HomogenizedCell &cell,
                                     const UpsamplerOptions &options);
} // namespace homespun::localization
