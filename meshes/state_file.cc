// SPDX-License-Identifier: MIT
#include "meshes/state_file.h"

#include "meshes/errors.h"
#include "meshes/hdf5_writer.h"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <filesystem>

namespace homespun::meshes
{
void write_state(const ClothState &state, const std::string &file)
{
  if (!state.positions.allFinite() || !state.velocities.allFinite())
    throw BadInput(file + ": the state is not finite; nothing was written");
  Hdf5Writer writer(file);
  const auto n = static_cast<unsigned long long>(state.positions.rows());
  writer.write("/positions", {n, 3}, state.positions.data(), "m");
  writer.write("/velocities", {n, 3}, state.velocities.data(), "m/s");
  writer.attribute("/", "time", state.time);
  writer.attribute("/", "frame", state.frame);
  writer.finish();
}

std::optional<ClothState> read_state(const std::string &file, const int n_vertices)
{
  if (!std::filesystem::exists(file))
    return std::nullopt;
  silence_hdf5();
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ClothState state;
  state.positions.resize(n_vertices, 3);
  state.velocities.resize(n_vertices, 3);
  const auto read = [&](const char *name, double *values)
  {
    int rank         = 0;
    hsize_t shape[2] = {0, 0};
    H5T_class_t type;
    std::size_t bytes;
    return H5LTfind_dataset(id, name) == 1 && H5LTget_dataset_ndims(id, name, &rank) >= 0 &&
           rank == 2 && H5LTget_dataset_info(id, name, shape, &type, &bytes) >= 0 &&
           shape[0] == static_cast<hsize_t>(n_vertices) && shape[1] == 3 &&
           H5LTread_dataset_double(id, name, values) >= 0;
  };
  const bool good = id >= 0 && read("positions", state.positions.data()) &&
                    read("velocities", state.velocities.data()) &&
                    H5LTget_attribute_double(id, "/", "time", &state.time) >= 0 &&
                    H5LTget_attribute_int(id, "/", "frame", &state.frame) >= 0 &&
                    state.positions.allFinite() && state.velocities.allFinite();
  if (id >= 0)
    H5Fclose(id);
  if (!good)
    throw BadInput(
      file + ": holds no state of " + std::to_string(n_vertices) +
      " vertices; expected what the same run wrote: leave out --resume, or remove the file");
  return state;
}
} // namespace homespun::meshes
