// SPDX-License-Identifier: MIT
// Half strips 0 < y_n of whole cells, periodic along an edge: what fields at the edge become
// further in, of a membrane (edge_layers.h) and of a plate (plate_edges.h).
#pragma once

#include "homogenization/edges/condensed_cell.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
struct EdgeOptions
{
  unsigned int order = 1;     ///< 1 or 2, of the displacement elements of a membrane
  int most_cells     = 400;   ///< that a half strip may take
  double left_at_end = 1e-13; ///< of the slowest mode at the end of its half strip
  double kept        = 1e-3;  ///< fields below this part of the largest |w_a| are not kept
};

/// What an edge of a cell looks like.
struct EdgeFrame
{
  Eigen::Vector2d along, inwards; ///< unit vectors t and n
  double length;                  ///< of one cell [m]
  double period;                  ///< of the cell along n, |Y| over the length [m]

  /// Rows that make t . sigma e and n . sigma e of a stress in Voigt order.
  Eigen::Matrix<double, 2, 3> components(const Eigen::Vector2d &e) const;
};

/// A row of cells that begins at an edge. Loads are in columns.
class HalfStrip
{
public:
  /// @param cell condensed along the axis of the edge
  /// @param side of the sheet, one of the two of that axis, see meshes::CellEdges
  HalfStrip(const CondensedCell &cell, int side);

  /// Fields on the lines between cells, edge first, one matrix (n_side_dofs,loads) each.
  using Lines = std::vector<Eigen::MatrixXd>;

  /// What is given on the edge, with no force on the other end.
  Lines held(const Eigen::MatrixXd &first, int n_cells) const;

  /// Under forces on the edge, with the other end held.
  Lines loaded(const Eigen::MatrixXd &force, int n_cells) const;

  /// Fields of one of the cells (n_dofs,loads).
  Eigen::MatrixXd in_cell(const Lines &lines, int k) const;

  /// The fields at the vertices of the first cells.
  /// @tparam n_dofs of a vertex
  /// @return row k n + v is vertex v (of n) of cell k, columns n_dofs a + i (n_cells n,3 n_dofs)
  template <int n_dofs>
  Eigen::Matrix<double, Eigen::Dynamic, 3 * n_dofs, Eigen::RowMajor>
  at_vertices(const Lines &lines, const int n_cells) const
  {
    const int n = cell.elements.cell.mesh.n_vertices();
    Eigen::Matrix<double, Eigen::Dynamic, 3 * n_dofs, Eigen::RowMajor> modes(n_cells * n,
                                                                             3 * n_dofs);
    for (int k = 0; k < n_cells; ++k)
    {
      const Eigen::MatrixXd all = in_cell(lines, k);
      for (int v = 0; v < n; ++v)
        for (int a = 0; a < 3; ++a)
          modes.row(k * n + v).template segment<n_dofs>(n_dofs * a) =
            all.middleRows<n_dofs>(cell.first_dof(v)).col(a).transpose();
    }
    return modes;
  }

  /// Sum over all cells of linear functionals of their fields.
  /// @param functionals (n_dofs,m)
  /// @return (m,loads)
  Eigen::MatrixXd summed(const Eigen::MatrixXd &functionals, const Lines &lines) const;

  /// A DoF of the cell at the edge that lies on it.
  int edge_dof(const int k) const
  {
    return is_far ? cell.n_dofs() - cell.n_side_dofs() + k : cell.side[static_cast<std::size_t>(k)];
  }

  /// How far a point of the cell is from its side towards the edge, 1 on the other one.
  double depth(const Eigen::RowVector2d &point) const
  {
    const double fraction = cell.elements.fraction(point)(cell.axis);
    return is_far ? 1. - fraction : fraction;
  }

  const CondensedCell &cell;
  const bool is_far; ///< the edge is where the lattice coordinate is largest
  const EdgeFrame frame;

private:
  Lines followed(Eigen::MatrixXd first, const std::vector<Eigen::MatrixXd> &steps) const;

  SideStiffness sides; ///< the first towards the edge
};

/// Cells after which what decays has gone.
/// @throws BadInput where it decays too slowly for the cells that it may take, with the factor
int cells_of_strip(const CondensedCell &cell, const EdgeOptions &options, double factor);

/// How many lines from the edge on hold a value above a size: loads excite the slowest mode little
/// or not at all, so that these are fewer than it would take.
/// @param sizes of each DoF (n_side_dofs)
int lines_above(const Eigen::VectorXd &sizes, const HalfStrip::Lines &lines);
} // namespace homespun::homogenization
