// SPDX-License-Identifier: MIT
// Positions of a level as files: pictures (fields-LOAD.h5, sheet-LOAD-STRAIN.vtu), and what
// `strain --keep` leaves for methods of other people, in CELL/positions/:
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

/// Positions of one sheet at one strain, for pictures of the report and for ParaView.
struct SheetFields
{
  std::string load;
  double strain;
  std::string reference, method;
  const meshes::Points &fine;      ///< (n,2) positions of the reference [m]
  const meshes::Points &upsampled; ///< (n,2) [m]
  const meshes::Points &affine;    ///< (n,2) the coarse motion, interpolated [m]
  const meshes::Points &coarse;    ///< (n_coarse,2) [m]
};

/// Writes /rest, /triangles, /material, /reference, /upsampled, /coarse_rest, /coarse_triangles,
/// /coarse in m, with the attributes load, strain, reference and method, whole or not at all.
void write_sheet_fields(const std::string &path, const meshes::Sheet &sheet,
                        const meshes::TriangleMesh &coarse_rest, const SheetFields &fields);

/// Writes the sheet at rest as .vtu: on its vertices the displacements of the reference, of
/// `affine` and of the method [m], by which ParaView warps it, and the distance of both from the
/// reference; on its triangles the phase.
void write_sheet_vtu(const std::string &path, const meshes::Sheet &sheet,
                     const SheetFields &fields);
} // namespace homespun::verification
