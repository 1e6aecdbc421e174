// SPDX-License-Identifier: MIT
// Sheets of N1 x N2 unit cells: the resolved mesh of all their triangles, and the coarse mesh of
// two triangles per cell that is to stand for it.
#pragma once

#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>

namespace homespun::meshes
{
/// A half of one of four quads that the halves of a cell's sides make: below or above the diagonal
/// from the quad's origin.
struct QuadHalf
{
  int quad1, quad2; ///< 0 or 1 along a1 and a2
  bool is_above;
};

/// Those of a cell: first four below its own diagonal, then four above.
constexpr std::array<QuadHalf, 8> eighths_of_cell = {{{0, 0, false},
                                                      {1, 0, false},
                                                      {1, 0, true},
                                                      {1, 1, false},
                                                      {0, 0, true},
                                                      {0, 1, false},
                                                      {0, 1, true},
                                                      {1, 1, true}}};

/// A resolved sheet of n1 x n2 cells and where each of its vertices comes from.
///
/// Vertices stand cell by cell: first those of cell (0,0), then (1,0), ...; within a cell the ones
/// in the coarse triangle below the diagonal from the cell's origin to its opposite corner come
/// first, and within each half in the order of eighths_of_cell. Each shared vertex belongs to the
/// cell at its upper right; the vertices that close the sheet at its top and right stand at the
/// end. This order makes the up-sampling of a coarse mesh that is the lattice, or halves its sides,
/// a copy of one block per cell.
struct Sheet
{
  TriangleMesh mesh;
  Lattice lattice;
  Eigen::RowVector2d origin;               ///< lower-left corner of cell (0,0) [m]
  int n1                             = 0;  ///< cells along a1
  int n2                             = 0;  ///< cells along a2
  int n_per_cell                     = 0;  ///< vertices in the block of one cell
  std::array<int, 9> begin_of_eighth = {}; ///< of each eighth in that block, and the block's end
  Eigen::VectorXi cell_vertex;             ///< (n) vertex of the cell mesh it is an image of
  Eigen::Matrix<int, Eigen::Dynamic, 2>
    cell; ///< (n,2) cell whose lower-left half-open area holds it

  /// Coordinates of a point on the sheet, 0 to 1 from edge to edge.
  Eigen::RowVector2d fraction(const Eigen::RowVector2d &point) const;

  /// The sides of the sheet, rows n1 a1 and n2 a2 [m].
  Eigen::Matrix2d sides() const;
};

/// Whether tile() takes a cell.
bool makes_sheets(const TriangleMesh &cell_mesh, const Lattice &lattice);

/// Tiles a periodic cell whose outline is the parallelogram of its lattice.
/// @param cell_mesh periodic modulo the lattice
/// @param n1, n2 number of cells along a1 and a2, at least 1
/// @throws BadInput where the outline is not that parallelogram, or the cell is not periodic
Sheet tile(const TriangleMesh &cell_mesh, const Lattice &lattice, int n1, int n2);

/// The coarse mesh of a sheet: n1 x n2 parallelograms that span origin to origin + (n1, n2) steps,
/// each cut into two triangles along the diagonal from its lower-left corner.
///
/// Vertex (i, j) has the index j (n1 + 1) + i; parallelogram (i, j) has the triangles
/// 2 (j n1 + i) below the diagonal and the next above it.
/// @param steps rows: the sides of one parallelogram [m]
TriangleMesh coarse_sheet(const Eigen::RowVector2d &origin, const Eigen::Matrix2d &steps, int n1,
                          int n2);
} // namespace homespun::meshes
