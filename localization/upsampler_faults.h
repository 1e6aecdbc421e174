// SPDX-License-Identifier: MIT
// What does not fit together of the parts that an up-sampler is made of. Private to upsampler.
#pragma once

#include "localization/options.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"

#include <string>
#include <vector>

namespace homespun::localization
{
/// Adds a fault where the lattice of a cell is not that of a fine mesh.
/// @param name of the fine mesh
void check_lattice(const meshes::HomogenizedCell &cell, const meshes::Lattice &lattice,
                   const std::string &name, std::vector<std::string> &faults);

/// Adds a fault where a place is none of a vertex of the cell and its images.
/// @param place in the frame of the cell [m]
/// @param name of the fine mesh whose vertex `fine` lies there
void check_image(const meshes::HomogenizedCell &cell, int vertex, const Eigen::RowVector2d &place,
                 const std::string &name, int fine, std::vector<std::string> &faults);

/// Faults between a cell and a sheet that was tiled from it; empty where they fit.
std::vector<std::string> sheet_faults(const meshes::HomogenizedCell &cell,
                                      const meshes::Sheet &sheet);

/// Faults of what the options ask for beside chi.
std::vector<std::string> mode_faults(const UpsamplerOptions &options);
} // namespace homespun::localization
