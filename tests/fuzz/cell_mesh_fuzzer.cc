// SPDX-License-Identifier: MIT
// Bytes as the mesh of a cell, a .msh; other formats are read by meshio, in a process of its own.
#include "homogenization/cell/cell_mesh_file.h"
#include "tests/fuzz/input_file.h"

using namespace homespun;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const tests::InputFile file(data, size, ".msh");
  tests::read_or_refuse(
    [&]()
    {
      const homogenization::CellMeshFile read = homogenization::read_cell_mesh(file.name);
      const meshes::TriangleMesh &mesh        = read.mesh;
      tests::must_hold(mesh.n_triangles() > 0, "a mesh has triangles");
      tests::must_hold(mesh.triangles.minCoeff() >= 0 &&
                         mesh.triangles.maxCoeff() < mesh.n_vertices(),
                       "corners are vertices");
      tests::must_hold(mesh.material.size() == mesh.n_triangles(), "every triangle has a group");
      tests::must_hold(read.angle.size() == 0 || read.angle.size() == mesh.n_triangles(),
                       "every triangle has an angle, or none");
    });
  return 0;
}
