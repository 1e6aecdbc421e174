// SPDX-License-Identifier: MIT
// What a study with --keep leaves for methods of other people, in CELL/positions/: a file with the
// meshes, and one of each state, with
//   /coarse (k,c) [m], what an up-sampler starts from, and
//   /reference (n,c) [m], what its fine positions are held against;
// c is 2 for sheets in their plane and 3 for cloths in space. The attribute `mesh` of a state is
// the checksum of the fine mesh, KeptMesh::checksum().
#pragma once

#include "meshes/files/hdf5_writer.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <functional>
#include <string>

namespace homespun::verification
{
using PositionRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The fine mesh of kept positions.
struct KeptMesh
{
  PositionRows vertices;       ///< (n,c), where it rests or begins [m]
  meshes::Triangles triangles; ///< (m,3)

  /// Sixteen hexadecimal digits of all its numbers.
  std::string checksum() const;
};

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

/// Adds the meshes of a sheet: /rest [m], /triangles, /material, and /coarse_rest [m],
/// /coarse_triangles.
void write_meshes(meshes::Hdf5Writer &file, const meshes::Sheet &sheet,
                  const meshes::TriangleMesh &coarse_rest);

/// Adds triangles (m,3).
void write_triangles(meshes::Hdf5Writer &file, const std::string &name,
                     const meshes::Triangles &triangles);

/// Writes NAME.h5 into a folder, whole.
/// @param mesh of the reference
/// @param describe adds attributes of the file
/// @throws BadInput where it cannot be written
void keep_state(const std::string &folder, const std::string &name, const KeptMesh &mesh,
                const KeptPositions &positions,
                const std::function<void(meshes::Hdf5Writer &)> &describe);

/// The mesh in a file of meshes.
/// @param vertices the dataset that the positions of states have the shape of
/// @throws BadInput where it was not kept, or the file is damaged
KeptMesh kept_mesh(const std::string &path, const std::string &vertices);

/// The positions of the reference in NAME.h5 of a folder.
/// @throws BadInput where they were not kept, are of another mesh, or the file is damaged
PositionRows kept_reference(const std::string &folder, const std::string &name,
                            const KeptMesh &mesh);
} // namespace homespun::verification
