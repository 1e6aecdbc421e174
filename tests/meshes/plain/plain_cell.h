// SPDX-License-Identifier: MIT
// A homogenized cell with everything that a cell must have, and no more.
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "tests/meshes/plain/shapes.h"

namespace homespun::tests
{
/// A parallelogram of n1 x n2 x 2 triangles of one phase, chi = 0.
inline meshes::HomogenizedCell plain_cell(const meshes::Lattice &lattice, const int n1,
                                          const int n2)
{
  meshes::HomogenizedCell cell;
  cell.lattice = lattice;
  cell.mesh    = parallelogram(lattice, n1, n2);
  cell.chi.setZero(cell.mesh.n_vertices(), 6);
  cell.stiffness     = Eigen::Vector3d(3., 2., 1.).asDiagonal();
  cell.areal_density = 0.2;
  return cell;
}
} // namespace homespun::tests
