// SPDX-License-Identifier: MIT
// Cells for tests of waves: shipped ones on their given P1 mesh, and the same cloth cut otherwise.
#pragma once

#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/sheet.h"
#include "verification/periodic/bloch_margin.h"
#include "verification/periodic/periodic_path.h"

#include <memory>
#include <string>
#include <vector>

namespace homespun::tests
{
/// [N/m]
inline Eigen::Matrix3d isotropic(const double E, const double nu)
{
  Eigen::Matrix3d C;
  C << 1., nu, 0., nu, 1., 0., 0., 0., 0.5 * (1. - nu);
  return E / (1. - nu * nu) * C;
}

/// The states along a load.
inline verification::PeriodicPath path_along(const verification::CellAssembly &assembly,
                                             const std::string &load)
{
  return {assembly, verification::load_control(verification::Load(load)), {0.02, 5}};
}

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
