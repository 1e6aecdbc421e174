// SPDX-License-Identifier: MIT
// A mesh of a cell under a law, with what its periodic states share.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/refine.h"
#include "verification/bloch/bloch_margin.h"

#include <vector>

namespace homespun::verification
{
struct MeshOfCell
{
  MeshOfCell(const homogenization::UnitCell &unit, const int n_refinements, const Law law)
      : law(law)
      , phases(unit.stiffness_of_phase())
      , cell(cell_of(meshes::refined(unit.mesh, n_refinements), unit.lattice))
      , assembly(cell, phases, law)
      , bloch(assembly)
  {
  }

  const Law law;
  const std::vector<Eigen::Matrix3d> phases; ///< (3,3) each [N/m]
  const meshes::HomogenizedCell cell;        ///< mesh, lattice and anchor alone
  const CellAssembly assembly;
  const BlochMargin bloch;

private:
  static meshes::HomogenizedCell cell_of(const meshes::TriangleMesh &mesh,
                                         const meshes::Lattice &lattice)
  {
    meshes::HomogenizedCell cell;
    cell.mesh    = mesh;
    cell.lattice = lattice;
    cell.anchor  = meshes::anchor_vertex(mesh, lattice);
    return cell;
  }
};
} // namespace homespun::verification
