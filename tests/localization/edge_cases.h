// SPDX-License-Identifier: MIT
// Modes of edges and fitted modes of no cell, all entries different, that the tests share.
#pragma once

#include "tests/localization/localization_cases.h"

#include <cmath>

namespace homespun::tests
{
/// Modes of two cells, of three at the last side, all entries different; at vertices that are
/// images of each other along an edge they agree, and across it where one cell ends and the next
/// begins.
inline meshes::CellEdges edges_of(const meshes::HomogenizedCell &cell)
{
  meshes::CellEdges edges;
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    meshes::CellEdge &edge = edges.sides[static_cast<std::size_t>(side)];
    edge.n_cells           = side == 3 ? 3 : 2;
    edge.slip << 1e-3, -2e-3, 5e-4 * side, 3e-4, 1e-3 * side, -1e-3;
    const int n = cell.mesh.n_vertices();
    edge.clamped.resize(edge.n_cells * n, 6);
    edge.free.resize(edge.n_cells * n, 6);
    const int axis = meshes::axis_of_side(side);
    for (int k = 0; k < edge.n_cells; ++k)
      for (int v = 0; v < n; ++v)
      {
        const Eigen::RowVector2d f =
          cell.lattice.fractional(cell.mesh.vertices.row(v) - cell.mesh.vertices.row(cell.anchor));
        const double depth = k + (meshes::is_far_side(side) ? 1. - f(axis) : f(axis));
        for (int c = 0; c < 6; ++c)
        {
          const double wave          = std::sin(2. * M_PI * f(1 - axis) + c + side);
          edge.clamped(k * n + v, c) = 1e-3 * (wave + 0.3 * c) * std::exp(-depth);
          edge.free(k * n + v, c)    = 1e-3 * (wave - 0.2 * c) * std::exp(-2. * depth);
        }
      }
  }
  return edges;
}

/// Modes whose effective strain is larger than the strain, smaller, or of the other sign.
inline meshes::FittedModes fitted_to(const meshes::HomogenizedCell &cell)
{
  meshes::FittedModes modes;
  modes.low << -0.3, -0.3, -0.3;
  modes.high << 0.3, 0.3, 0.3;
  modes.knees << 0.02, 0.5, 0.2;
  modes.modes.setRandom(cell.mesh.n_vertices(), modes.modes.cols());
  modes.coefficients.setRandom();
  for (int j = 0; j < meshes::FittedModes::n_functions; ++j)
    modes.of_strain.row(j) << std::sin(3. * j), 3. * std::sin(5. * j), 2. * std::cos(7. * j);
  return modes;
}
} // namespace homespun::tests
