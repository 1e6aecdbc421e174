// SPDX-License-Identifier: MIT
// What a study with --keep leaves for methods of other people, in CELL/positions/: a file with the
// meshes, and one of each state, with
//   /coarse (k,c) [m], what an up-sampler starts from, and
//   /reference (n,c) [m], what its fine positions are held against;
// c is 2 for sheets in their plane and 3 for cloths in space.
#pragma once

#include "meshes/files/hdf5_writer.h"

#include <Eigen/Core>

#include <functional>
#include <string>

namespace homespun::verification
{
using PositionRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The positions that a state compares [m].
struct KeptPositions
{
  PositionRows coarse;    ///< of the coarse cloth of `localized`
  PositionRows reference; ///< of the resolved one
};

/// The folder of the kept positions of a cell in that of a run.
std::string folder_of_positions(const std::string &run, const std::string &cell);

/// Adds positions [m] to a file.
void write_positions(meshes::Hdf5Writer &file, const std::string &name,
                     const PositionRows &positions);

/// Writes NAME.h5 into a folder, whole.
/// @param describe adds attributes of the file
/// @throws BadInput where it cannot be written
void keep_state(const std::string &folder, const std::string &name, const KeptPositions &positions,
                const std::function<void(meshes::Hdf5Writer &)> &describe);

/// The positions of the reference in NAME.h5 of a folder.
/// @throws BadInput where they were not kept, or the file is damaged
PositionRows kept_reference(const std::string &folder, const std::string &name, int n_vertices,
                            int n_components);
} // namespace homespun::verification
