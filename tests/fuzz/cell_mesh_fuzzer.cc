// SPDX-License-Identifier: MIT
// Bytes as the mesh of a cell, in the format that the first of them chooses.
#include "homogenization/cell/cell_mesh_file.h"
#include "tests/fuzz/input_file.h"

#include <map>
#include <string>

using namespace homespun;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const std::map<char, std::string> ending_of = {
    {'m', ".msh"}, {'k', ".vtk"}, {'u', ".vtu"}, {'c', ".ucd"}, {'i', ".inp"}, {'n', ".unv"}};
  const auto ending = size == 0 ? ending_of.end() : ending_of.find(static_cast<char>(data[0]));
  if (ending == ending_of.end())
    return -1; // not worth keeping
  const tests::InputFile file(data + 1, size - 1, ending->second);
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
