// SPDX-License-Identifier: MIT
#include "verification/record/kept_positions.h"

#include "meshes/files/hdf5_reader.h"
#include "meshes/plain/errors.h"

#include <filesystem>

namespace homespun::verification
{
std::string folder_of_positions(const std::string &run, const std::string &cell)
{
  return run + "/" + cell + "/positions";
}

void write_positions(meshes::Hdf5Writer &file, const std::string &name,
                     const PositionRows &positions)
{
  file.write(name,
             {static_cast<unsigned long long>(positions.rows()),
              static_cast<unsigned long long>(positions.cols())},
             positions.data(), "m");
}

void keep_state(const std::string &folder, const std::string &name, const KeptPositions &positions,
                const std::function<void(meshes::Hdf5Writer &)> &describe)
{
  std::filesystem::create_directories(folder);
  meshes::Hdf5Writer file(folder + "/" + name + ".h5");
  write_positions(file, "/coarse", positions.coarse);
  write_positions(file, "/reference", positions.reference);
  describe(file);
  file.finish();
}

PositionRows kept_reference(const std::string &folder, const std::string &name,
                            const int n_vertices, const int n_components)
{
  const std::string path = folder + "/" + name + ".h5";
  if (!std::filesystem::exists(path))
    throw meshes::BadInput(path + ": is not there; expected the positions of the reference, which "
                                  "`homespun strain --keep` or `drape --keep` leaves: run the "
                                  "study with it");
  const std::vector<double> values =
    meshes::Hdf5Reader(path, "the positions of a state")
      .numbers("/reference", {static_cast<unsigned long long>(n_vertices),
                              static_cast<unsigned long long>(n_components)});
  return Eigen::Map<const PositionRows>(values.data(), n_vertices, n_components);
}
} // namespace homespun::verification
