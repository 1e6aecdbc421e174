// SPDX-License-Identifier: MIT
// Up-sampling of violent coarse motions, within the bound of the method: a fine vertex is no
// further from its place in the coarse triangles than the largest lift times the largest strain
// times the largest characteristic displacement.
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "verification/stress/stress_axis.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Sheets of 4 x 4 cells.
/// @param name of the cell
std::vector<StressAxis> localization_axes(const meshes::HomogenizedCell &cell,
                                          const std::string &name);
} // namespace homespun::verification
