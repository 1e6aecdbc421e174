// SPDX-License-Identifier: MIT
// Bytes as the .prm of a cell, beside a sound mesh.
#include "homogenization/cell/unit_cell.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/fuzz/input_file.h"

#include <filesystem>

using namespace homespun;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const tests::InputFile file(data, size, ".prm");
  static const bool mesh_is_there =
    std::filesystem::copy_file(HOMESPUN_SOURCE_DIR "/meshes/cells/layered.msh", "/tmp/layered.msh",
                               std::filesystem::copy_options::overwrite_existing);
  tests::must_hold(mesh_is_there, "the mesh is there");
  tests::read_or_refuse(
    [&]()
    {
      const homogenization::UnitCell cell = homogenization::read_unit_cell(file.name);
      for (const Eigen::Matrix3d &c : cell.stiffness_of_phase())
        tests::must_hold(c.allFinite(), "a stiffness is finite");
      tests::must_hold(cell.areal_density() > 0., "a cell has mass");
    });
  return 0;
}
