// SPDX-License-Identifier: MIT
// What `strain --keep` leaves for methods of other people, in CELL/positions/:
//   sheet.h5, periodic.h5   the meshes of the sheets, and of the cells that repeat in an infinite
//                           cloth: /rest (n,2) [m]  /triangles (m,3)  /material (m), phases from 0
//                           /coarse_rest (k,2) [m]  /coarse_triangles (l,3)
//   LOAD-LAW-STRAIN.h5      a level (record/kept_positions.h)
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/record/kept_positions.h"
#include "verification/strain/strain_output.h"

#include <string>

namespace homespun::verification
{
/// `strip-1-biot-0.01`: what files of a level are called.
std::string file_name_of(const StrainLevel &level);

/// Writes the positions of a level, each file whole, and the meshes unless they are there.
/// @throws BadInput where a file cannot be written
void keep(const std::string &run, const StrainLevel &level, const meshes::Sheet &sheet,
          const meshes::TriangleMesh &coarse_rest, const KeptPositions &positions);

/// How much a study keeps at most, said before it starts.
std::string note_on_keeping(const StrainStudyOptions &options,
                            const std::vector<homogenization::UnitCell> &cells);
} // namespace homespun::verification
