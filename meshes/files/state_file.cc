// SPDX-License-Identifier: MIT
#include "meshes/files/state_file.h"

#include "meshes/files/hdf5_reader.h"
#include "meshes/files/hdf5_writer.h"
#include "meshes/plain/errors.h"

#include <cmath>
#include <filesystem>
#include <utility>

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
  const std::string what =
    "what the same run wrote: begin anew with --overwrite, or remove the file";
  const Hdf5Reader reader(file, what);
  const auto n = static_cast<unsigned long long>(n_vertices);
  ClothState state;
  for (const auto &[name, field] :
       {std::pair("/positions", &state.positions), std::pair("/velocities", &state.velocities)})
    *field = Eigen::Map<const SpacePoints>(reader.numbers(name, {n, 3}).data(), n_vertices, 3);
  state.step_seconds     = reader.numbers("/step_seconds", {Hdf5Reader::any});
  const auto run_of_file = reader.text_attribute("/", "run");
  const auto time        = reader.number_attribute("/", "time");
  const auto frame       = reader.integer_attribute("/", "frame");
  if (!run_of_file || !time || !frame || !std::isfinite(*time) || *frame < 0 ||
      !state.positions.allFinite() || !state.velocities.allFinite())
    throw BadInput(file + ": holds no state of a run; expected " + what);
  state.run   = *run_of_file;
  state.time  = *time;
  state.frame = *frame;
  if (state.run != run)
    throw BadInput(file + ": holds the state of a run with other inputs (" + state.run +
                   "); expected that of this one (" + run +
                   "): begin anew with --overwrite, or choose another --output");
  return state;
}
} // namespace homespun::meshes
