// SPDX-License-Identifier: MIT
// An OBJ as a cloth and as a closed surface. What was read is finite, its indices exist, and it is
// written and read again without a change.
#include "meshes/files/obj_file.h"
#include "tests/fuzz/input_file.h"

using namespace homespun;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const tests::InputFile file(data, size, ".obj"), copy(nullptr, 0, "-copy.obj");
  const auto is_sound = [](const meshes::Triangles &triangles, const Eigen::Index n)
  { return triangles.size() > 0 && triangles.minCoeff() >= 0 && triangles.maxCoeff() < n; };
  tests::read_or_refuse(
    [&]()
    {
      const meshes::ClothMesh cloth = meshes::read_cloth(file.name);
      tests::must_hold(cloth.positions.allFinite() && cloth.rest.vertices.allFinite(),
                       "a cloth is finite");
      tests::must_hold(is_sound(cloth.triangles, cloth.positions.rows()),
                       "a cloth's vertices exist");
      meshes::write_obj(copy.name, cloth);
      const meshes::ClothMesh again = meshes::read_cloth(copy.name);
      tests::must_hold(again.positions == cloth.positions, "a cloth is read as it was written");
    });
  tests::read_or_refuse(
    [&]()
    {
      const meshes::Surface surface = meshes::read_surface(file.name);
      tests::must_hold(surface.positions.allFinite() &&
                         is_sound(surface.triangles, surface.positions.rows()),
                       "a surface is sound");
    });
  return 0;
}
