// SPDX-License-Identifier: MIT
// What a periodic cloth does at its edges, to first order in the cell: the terms that the
// homogenized sheet and the characteristic displacements leave out there. Plain data.
#pragma once

#include <Eigen/Core>

#include <array>

namespace homespun::meshes
{
/// Fields at the vertices of a row of cells that begins at an edge and goes inwards: row k n + v is
/// vertex v (of n) of cell k, columns as those of Chi [m].
using EdgeModes = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// An edge of the cloth on a lattice line, clamped or free. All fields are per unit macro strain,
/// a = 11, 22, 12 (engineering shear), and belong to the fluctuation w_a = −chi_a with mean zero
/// over the cell.
struct CellEdge
{
  Eigen::Matrix<double, 2, 3> slip; ///< d_a [m]: a clamped edge lies d_a E_a off where it is drawn
  Eigen::Vector3d tension;          ///< T_a [N] along a free edge, positive where it pulls
  double decay = 0.; ///< by which the slowest of all modes shrinks from one cell to the next
  int n_cells  = 0;  ///< that the modes take
  EdgeModes clamped; ///< phi_a − d_a (n_cells n,6) [m], −w_a − d_a on the edge
  EdgeModes free;    ///< phi_a (n_cells n,6) [m]
};

/// The four edges of a sheet of whole cells, and what the cell does under strain gradients.
struct CellEdges
{
  /// Number of an edge in `sides`: 0 and 1 are the edges where the first lattice coordinate is
  /// smallest and largest, 2 and 3 those of the second.
  static constexpr int n_sides = 4;
  std::array<CellEdge, n_sides> sides;
  /// M_abc = <(sigma_c e_b).w_a> − <(sigma_a e_b).w_c> [N], entry (a, c) of bulk[b], b = x, y.
  std::array<Eigen::Matrix3d, 2> bulk;
};

/// Lattice coordinate that is constant on an edge.
constexpr int axis_of_side(const int side)
{
  return side / 2;
}

/// Whether it is the end where that coordinate is largest.
constexpr bool is_far_side(const int side)
{
  return side % 2 == 1;
}
} // namespace homespun::meshes
