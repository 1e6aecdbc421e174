// SPDX-License-Identifier: MIT
// What all cells of a sheet share where the coarse mesh is its lattice, or halves the sides of
// that: one table, and what edges with modes change for each way in which they reach a cell.
// Private to upsampler.
#pragma once

#include "localization/cell_triangles.h"
#include "localization/edge_modes.h"
#include "localization/vertex_table.h"
#include "meshes/plain/point_location.h"
#include "meshes/plain/sheet.h"

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace homespun::localization
{
template <typename Scalar>
struct CellTables
{
  int quads   = 0; ///< of the coarse mesh along a side of a cell, 1 or 2; 0: it is none of these
  int n_cells = 0; ///< each with one block of vertices
  int n_along = 0; ///< of these, along the first axis
  int n_block = 0; ///< vertices per block

  std::vector<CellTriangle> triangles; ///< of a cell
  std::vector<int> first_row;          ///< in the tables, of each of these
  VertexTable<Scalar> shared;          ///< triangle by triangle
  /// One for each way of being reached.
  std::vector<std::vector<ChiBlock<Scalar>>> chi_of_kind, free_of_kind;
  std::vector<int> kind_of_cell;

  /// The constants of a cell, from a row on with which a block begins.
  Blocks<Scalar> from(const int row, const int cell) const
  {
    const auto kind = static_cast<std::size_t>(kind_of_cell[static_cast<std::size_t>(cell)]);
    return shared.from(row, chi_of_kind[kind], free_of_kind[kind]);
  }

  /// @param n_quads per side of a cell, 1 or 2
  /// @param append a fine vertex, with its place in a coarse triangle, to a table
  template <typename Append>
  void fill(const meshes::Sheet &sheet, const int n_quads, const EdgeModes &near_edges,
            const Panel &panel, const Append &append)
  {
    quads     = n_quads;
    n_cells   = sheet.n1 * sheet.n2;
    n_along   = sheet.n1;
    n_block   = sheet.n_per_cell;
    triangles = triangles_of_cell(sheet, quads);
    first_row.resize(triangles.size());
    std::map<std::vector<int>, int> kind_at;
    for (int cell = 0; cell < n_cells; ++cell)
    {
      const auto [found, is_new] =
        kind_at.emplace(near_edges.depths(panel, cell % n_along, cell / n_along),
                        static_cast<int>(chi_of_kind.size()));
      kind_of_cell.push_back(found->second);
      if (!is_new)
        continue;
      VertexTable<Scalar> table;
      for (std::size_t t = 0; t < triangles.size(); ++t)
      {
        table.pad();
        first_row[t] = table.size;
        for (int k = triangles[t].begin; k < triangles[t].end; ++k)
          append(table, cell * n_block + k,
                 meshes::Location{coarse_triangle(triangles[t].in_cell, quads, n_along,
                                                  cell % n_along, cell / n_along),
                                  weights_in(triangles[t].in_cell, quads, sheet, k)});
      }
      chi_of_kind.push_back(std::move(table.chi_blocks));
      free_of_kind.push_back(std::move(table.free_blocks));
      shared = std::move(table);
    }
  }
};
} // namespace homespun::localization
