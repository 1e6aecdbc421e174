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
  writer.write("/step_seconds", {static_cast<unsigned long long>(state.step_seconds.size())},
               state.step_seconds.data(), "s");
  writer.attribute("/", "run", state.run);
  writer.attribute("/", "time", state.time);
  writer.attribute("/", "frame", state.frame);
  writer.finish();
}

std::optional<ClothState> read_state(const std::string &file, const int n_vertices,
                                     const std::string &run)
{
  if (!std::filesystem::exists(file))
    return std::nullopt;
  silence_hdf5();
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ClothState state;
  state.positions.resize(n_vertices, 3);
  state.velocities.resize(n_vertices, 3);
  H5T_class_t type;
  std::size_t bytes = 0;
  const auto read   = [&](const char *name, double *values)
  {
    int rank         = 0;
    hsize_t shape[2] = {0, 0};
    return H5LTfind_dataset(id, name) == 1 && H5LTget_dataset_ndims(id, name, &rank) >= 0 &&
           rank == 2 && H5LTget_dataset_info(id, name, shape, &type, &bytes) >= 0 &&
           shape[0] == static_cast<hsize_t>(n_vertices) && shape[1] == 3 &&
           H5LTread_dataset_double(id, name, values) >= 0;
  };
  const auto read_seconds = [&]()
  {
    int rank  = 0;
    hsize_t n = 0;
    if (H5LTfind_dataset(id, "step_seconds") != 1 ||
        H5LTget_dataset_ndims(id, "step_seconds", &rank) < 0 || rank != 1 ||
        H5LTget_dataset_info(id, "step_seconds", &n, &type, &bytes) < 0)
      return false;
    state.step_seconds.resize(n);
    return n == 0 || H5LTread_dataset_double(id, "step_seconds", state.step_seconds.data()) >= 0;
  };
  const auto read_run = [&]()
  {
    hsize_t unused = 0;
    if (H5LTfind_attribute(id, "run") != 1 ||
        H5LTget_attribute_info(id, "/", "run", &unused, &type, &bytes) < 0 || type != H5T_STRING)
      return false;
    std::vector<char> text(bytes + 1, '\0');
    if (H5LTget_attribute_string(id, "/", "run", text.data()) < 0)
      return false;
    state.run = text.data();
    return true;
  };
  const bool good = id >= 0 && read("positions", state.positions.data()) &&
                    read("velocities", state.velocities.data()) && read_seconds() && read_run() &&
                    H5LTget_attribute_double(id, "/", "time", &state.time) >= 0 &&
                    H5LTget_attribute_int(id, "/", "frame", &state.frame) >= 0 &&
                    state.positions.allFinite() && state.velocities.allFinite();
  if (id >= 0)
    H5Fclose(id);
  if (!good)
    throw BadInput(
      file + ": holds no state of " + std::to_string(n_vertices) +
      " vertices; expected what the same run wrote: leave out --resume, or remove the file");
  if (state.run != run)
    throw BadInput(file + ": holds the state of a run with other inputs (" + state.run +
                   "); expected that of this one (" + run +
                   "): leave out --resume to begin anew, or choose another --output");
  return state;
}
} // namespace homespun::meshes
