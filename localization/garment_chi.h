// SPDX-License-Identifier: MIT
// chi at the fine vertices of a garment: that of its cell, interpolated where an outline cuts a
// cell, turned with the grain of the panel, and faded to zero at seams. Private to upsampler.
#pragma once

#include "meshes/garment/fine_cloth.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::localization
{
/// Refers to what it is made of.
class GarmentChi
{
public:
  /// @param chi anchored chi of the cell (n_cell,6) [m]
  /// @param fade distance from a seam over which chi grows from zero to its full size [m]
  GarmentChi(const meshes::HomogenizedCell &cell, const meshes::Chi &chi,
             const meshes::FineCloth &fine, double fade);

  /// chi at a fine vertex in the rest frame of its panel, column 2 a + c [m].
  Eigen::Matrix<double, 1, 6> operator()(int v) const;

private:
  const meshes::HomogenizedCell &cell;
  const meshes::Chi &chi;
  const meshes::FineCloth &fine;
  const double fade;
  std::vector<Eigen::Matrix<double, 6, 6>> turned; ///< chi row times map, of each panel
};
} // namespace homespun::localization
