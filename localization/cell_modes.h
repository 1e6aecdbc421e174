// SPDX-License-Identifier: MIT
// The modes of a cell that the options of an up-sampler ask for. Private to upsampler and
// placed_garment.
#pragma once

#include "localization/kernel.h"
#include "localization/options.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>

namespace homespun::localization
{
/// Modes of the cell's vertices, chi first (n,6), or with the quadratic or fitted ones (n,18), in
/// the parts that the kernel takes [m].
using CellModes =
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, Eigen::Dynamic, 18>;

Modes kind_of_modes(const UpsamplerOptions &options);

/// @throws BadInput where the cell lacks them, or they are not finite
CellModes cell_modes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options);
} // namespace homespun::localization
