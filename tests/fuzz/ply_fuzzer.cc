// SPDX-License-Identifier: MIT
// A PLY as a frame and as a flat mesh at rest. What was read is finite, and its indices exist.
#include "meshes/files/obj_file.h"
#include "meshes/files/polygons.h"
#include "tests/fuzz/input_file.h"

using namespace homespun;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const tests::InputFile file(data, size, ".ply");
  tests::read_or_refuse(
    [&]()
    {
      const meshes::Polygons mesh = meshes::read_ply(file.name);
      tests::must_hold(mesh.positions.allFinite(), "positions are finite");
      tests::must_hold(!mesh.faces.empty(), "a mesh has faces");
      for (const meshes::Polygon &face : mesh.faces)
        for (std::size_t k = 0; k < face.size(); ++k)
          tests::must_hold((face[k] >= 0 || k == 3) && face[k] < mesh.positions.rows(),
                           "a face's vertices exist");
      meshes::flat_cloth(mesh, file.name);
    });
  return 0;
}
