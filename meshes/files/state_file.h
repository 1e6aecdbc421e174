// SPDX-License-Identifier: MIT
// A moving cloth at one moment on disk, from which a run goes on as if it had not been interrupted:
// HDF5, /positions (n,3) [m], /velocities (n,3) [m/s], /step_seconds [s], attributes `time` [s],
// `frame` and `run`.
#pragma once

#include "meshes/cloth/cloth_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::meshes
{
struct ClothState
{
  SpacePoints positions;            ///< (n,3) [m]
  SpacePoints velocities;           ///< (n,3) [m/s]
  double time = 0.;                 ///< [s]
  int frame   = 0;                  ///< frames that are complete
  std::string run;                  ///< what names the run that it belongs to
  std::vector<double> step_seconds; ///< what each step took so far [s]
};

/// Writes a state whole or not at all, in place of the one that was there.
/// @throws BadInput where a number is not finite, or the file cannot be written
void write_state(const ClothState &state, const std::string &file);

/// @param run that is to go on
/// @return nothing where there is no such file
/// @throws BadInput for a file that holds no state of n vertices, or that of another run
std::optional<ClothState> read_state(const std::string &file, int n_vertices,
                                     const std::string &run);
} // namespace homespun::meshes
