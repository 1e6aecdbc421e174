// SPDX-License-Identifier: MIT
// What does not fit together of the parts that the up-sampler of a garment is made of. Private to
// placed_garment.
#pragma once

#include "localization/options.h"
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/garment/fine_cloth.h"
#include "meshes/plain/homogenized_cell.h"

#include <string>
#include <vector>

namespace homespun::localization
{
/// Faults of a coarse cloth, and between it, a cell and the fine cloth made from both; of the
/// vertices the first three.
std::vector<std::string> garment_faults(const meshes::HomogenizedCell &cell,
                                        const meshes::ClothMesh &coarse,
                                        const meshes::FineCloth &fine,
                                        const UpsamplerOptions &options);
} // namespace homespun::localization
