// SPDX-License-Identifier: MIT
// Positions of one sheet at one strain, for pictures: fields-LOAD.h5.
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
  const meshes::Points &coarse;    ///< (n_coarse,2) [m]
};

/// Writes /rest, /triangles, /material, /reference, /upsampled, /coarse_rest, /coarse_triangles,
/// /coarse in m, with the attributes load, strain, reference and method, whole or not at all.
void write_sheet_fields(const std::string &path, const meshes::Sheet &sheet,
                        const meshes::TriangleMesh &coarse_rest, const SheetFields &fields);
} // namespace homespun::verification
