// SPDX-License-Identifier: MIT
// The edges of a cell in cell.h5, beside what cell_file.h says. Edges 0 to 3 of a sheet of whole
// cells: where lattice coordinate 1 is smallest and largest, then 2. Last axis: macro strain 11,
// 22, 12 (engineering shear). All belong to w = −chi with mean zero over the cell.
//   /edges/slip (4,2,3) [m]      d: a clamped edge acts d E off where it is drawn, (x, y)
//   /edges/tension (4,3) [N]     T along a free edge, positive where it pulls
//   /edges/bulk (2,3,3) [N]      M: derivative of the strain by x, y; strain; strain of the test
//   /edges/decay (4)             by which modes shrink from cell to cell, at most
//   /edges/n_cells (4)           that the modes of an edge take
//   /edges/clamped_K, /edges/free_K (n_cells[K],n,2,3) [m], K = 0 ... 3: modes at the vertices of
//                                the cells from the edge inwards, those of a clamped edge without d
// Files without them are older, or of a cell whose edges have none.
#pragma once

#include "meshes/files/hdf5_reader.h"
#include "meshes/files/hdf5_writer.h"
#include "meshes/plain/cell_edges.h"
#include "meshes/plain/homogenized_cell.h"

#include <optional>
#include <string>

namespace homespun::meshes
{
/// Writes a cell with its edges as write_cell() does.
void write_cell(const HomogenizedCell &cell, const CellEdges &edges, const std::string &file);

/// The edges in a cell.h5; nothing where it has none.
/// @throws BadInput naming the file and the dataset
std::optional<CellEdges> read_cell_edges(const std::string &file);

/// Adds the edges to a file that is being written.
/// @param n_vertices of the cell
void write_edges(const CellEdges &edges, int n_vertices, Hdf5Writer &file);
} // namespace homespun::meshes
