// SPDX-License-Identifier: MIT
// The modes at the fine vertices of a garment: those of its cell, interpolated where an outline cuts a cell,
// turned with the grain of the panel, and faded to zero at seams. Private to upsampler.
#pragma once

#include "meshes/garment/fine_cloth.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::localization
{
/// Refers to what it is made of.
class GarmentModes
{
public:
  /// @param chi anchored modes of the cell (n_cell,6) [m]
  /// @param fade distance from a seam over which the modes grow from zero to their full size [m]
  GarmentModes(const meshes::HomogenizedCell &cell, const meshes::CharacteristicDisplacements &chi,
               const meshes::FineCloth &fine, double fade);

  /// Modes of a fine vertex in the rest frame of its panel, column 2 a + c [m].
  Eigen::Matrix<double, 1, 6> operator()(int v) const;

private:
  const meshes::HomogenizedCell &cell;
  const meshes::CharacteristicDisplacements &chi;
  const meshes::FineCloth &fine;
  const double fade;
  std::vector<Eigen::Matrix<double, 6, 6>> turned; ///< chi row times map, of each panel
};
} // namespace homespun::localization
