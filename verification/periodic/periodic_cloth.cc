// SPDX-License-Identifier: MIT
#include "verification/periodic/periodic_cloth.h"

#include "meshes/plain/refine.h"

namespace homespun::verification
{
namespace
{
/// What a cloth of a mesh, its lattice and its anchor is; chi and C^H are not used.
meshes::HomogenizedCell cell_of(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice)
{
  meshes::HomogenizedCell cell;
  cell.mesh    = mesh;
  cell.lattice = lattice;
  cell.anchor  = meshes::anchor_vertex(mesh, lattice);
  return cell;
}
} // namespace

CellAssembly resolved_cloth(const homogenization::UnitCell &cell, const int n_refinements,
                            const Law law)
{
  return {cell_of(meshes::refined(cell.mesh, n_refinements), cell.lattice),
          cell.stiffness_of_phase(), law};
}

CellAssembly uniform_cloth(const meshes::Lattice &lattice, const Eigen::Matrix3d &stiffness,
                           const Law law)
{
  meshes::TriangleMesh mesh;
  mesh.vertices.setZero(4, 2);
  mesh.vertices.row(1) = lattice.vectors.row(0);
  mesh.vertices.row(2) = lattice.vectors.row(0) + lattice.vectors.row(1);
  mesh.vertices.row(3) = lattice.vectors.row(1);
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  mesh.material.setZero(2);
  return {cell_of(mesh, lattice), {stiffness}, law};
}
} // namespace homespun::verification
