// SPDX-License-Identifier: MIT
// Cells for tests of waves: shipped ones on their given P1 mesh, and the same cloth cut otherwise.
#pragma once

#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/sheet.h"
#include "verification/bloch/bloch_margin.h"
#include "verification/bloch/strain_path.h"

#include <memory>
#include <string>
#include <vector>

namespace homespun::tests
{
/// A cell with the stiffness of its phases [N/m].
struct BlochCell
{
  explicit BlochCell(const std::string &name)
      : BlochCell(homogenization::read_unit_cell(CELLS + name + ".prm", MPI_COMM_WORLD))
  {
  }

  explicit BlochCell(const homogenization::UnitCell &unit)
      : BlochCell(unit.mesh, unit.lattice, unit.stiffness_of_phase())
  {
  }

  BlochCell(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
            const std::vector<Eigen::Matrix3d> &phases)
      : phases(phases)
  {
    cell.mesh    = mesh;
    cell.lattice = lattice;
    cell.anchor  = meshes::anchor_vertex(mesh, lattice);
  }

  /// n1 x n2 cells as one.
  BlochCell tiled(const int n1, const int n2) const
  {
    const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n1, n2);
    meshes::Lattice lattice   = cell.lattice;
    lattice.vectors.row(0) *= n1;
    lattice.vectors.row(1) *= n2;
    return {sheet.mesh, lattice, phases};
  }

  verification::CellAssembly assembly(const verification::Law law) const
  {
    return {cell, phases, law};
  }

  meshes::HomogenizedCell cell;
  std::vector<Eigen::Matrix3d> phases;
};
} // namespace homespun::tests
