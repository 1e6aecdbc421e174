// SPDX-License-Identifier: MIT
// What `strain --keep` leaves for methods of other people, in CELL/positions/:
//   sheet.h5, periodic.h5   the meshes of the sheets, and of the cells that repeat in an infinite
//                           cloth: /rest (n,2) [m]  /triangles (m,3)  /material (m), phases from 0
//                           /coarse_rest (k,2) [m]  /coarse_triangles (l,3)
//   LOAD-LAW-STRAIN.h5      a level: /coarse (k,2) [m], what an up-sampler starts from
//                           /reference (n,2) [m], what its fine positions are held against
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/strain/strain_output.h"

#include <string>

namespace homespun::verification
{
/// The positions that a level compares [m].
struct KeptPositions
{
  meshes::Points coarse;    ///< of the coarse cloth of `localized`
  meshes::Points reference; ///< of the resolved one
};

/// `strip-1-biot-0.01`: what files of a level are called.
std::string file_name_of(const StrainLevel &level);

/// The folder of the kept positions of a cell in that of a run.
std::string folder_of_positions(const std::string &run, const std::string &cell);

/// Writes the positions of a level, each file whole, and the meshes unless they are there.
/// @throws BadInput where a file cannot be written
void keep(const std::string &run, const StrainLevel &level, const meshes::Sheet &sheet,
          const meshes::TriangleMesh &coarse_rest, const KeptPositions &positions);

/// The positions of the reference at a level, shape (n,2) [m].
/// @throws BadInput where they were not kept, or the file is damaged
meshes::Points kept_reference(const std::string &run, const StrainLevel &level, int n_vertices);

/// How much a study keeps at most, said before it starts.
std::string note_on_keeping(const StrainStudyOptions &options,
                            const std::vector<homogenization::UnitCell> &cells);
} // namespace homespun::verification
