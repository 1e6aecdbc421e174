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
/// Modes of vertices of the cell, chi first (n,6), or with the quadratic or fitted ones (n,18), in
/// the parts that the kernel takes; of fine vertices also with what free edges take off chi behind
/// them, where that is apart (n,24) [m].
using CellModes =
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, Eigen::Dynamic, 24>;
using ModesRow = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 24>;

Modes kind_of_modes(const UpsamplerOptions &options);

/// @throws BadInput where the cell lacks them, or they are not finite
CellModes cell_modes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options);

/// What a cell that is bent has at its vertices per unit macro curvature: w_a (3) [m^2], then their
/// slopes, column 3 + 2 a + c, by finite differences over the triangles around a vertex [m].
using BentModes = Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor>;

/// @return (n,9) of the cell's vertices, w_a with the constant that the options give chi
/// @throws BadInput where the cell lacks its deflection, or it is not finite
BentModes bent_modes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options);
} // namespace homespun::localization
