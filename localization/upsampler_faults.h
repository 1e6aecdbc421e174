// SPDX-License-Identifier: MIT
// What does not fit together of the parts that an up-sampler is made of. Private to upsampler.
#pragma once

#include "localization/options.h"
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/garment/fine_cloth.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"

#include <string>
#include <vector>

namespace homespun::localization
{
/// Faults between a cell and a sheet that was tiled from it; empty where they fit.
std::vector<std::string> sheet_faults(const meshes::HomogenizedCell &cell,
                                      const meshes::Sheet &sheet);

/// Faults of what the options ask for beside chi.
std::vector<std::string> mode_faults(const UpsamplerOptions &options);

/// Faults of a coarse cloth, and between it, a cell and the fine cloth made from both; of the
/// vertices the first three.
std::vector<std::string> garment_faults(const meshes::HomogenizedCell &cell,
                                        const meshes::ClothMesh &coarse,
                                        const meshes::FineCloth &fine,
                                        const UpsamplerOptions &options);
} // namespace homespun::localization
