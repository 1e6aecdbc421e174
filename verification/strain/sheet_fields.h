// SPDX-License-Identifier: MIT
// Positions of one sheet at one strain, for pictures of the report (fields-LOAD.h5) and for
// ParaView (sheet-LOAD-STRAIN.vtu).
#pragma once

#include "meshes/plain/sheet.h"

#include <string>

namespace homespun::verification
{
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
