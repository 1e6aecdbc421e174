// SPDX-License-Identifier: MIT
// What a coarse motion tells of the error of up-sampling it, without a reference. Per coarse
// triangle, with E = U − I the strain that up-sampling takes (localization/coarse_frames.h), its
// principal values e1 >= e2, and l = sqrt(|Y|) the side of the cell; all dimensionless:
//
//   strain         max(|e1|, |e2|)
//     chi belongs to small strain; a range of validity is known where the cell went through
//     `homespun strain`
//   strain_change  l max |d . grad E| over unit directions d of the rest plane, E as it is blended
//     over the triangle, |E|^2 = E11^2 + E22^2 + gamma12^2/2: how far the strain of a cell is from
//     uniform, which homogenization takes it to be (scale separation). In triangles at an outline
//     the averages know one side alone: there it is most often too small, down to a third on a
//     regular mesh.
//   compression    max(0, -e2)
//     how much shorter the triangle is than at rest, along the direction in which it is so most.
//     Slack cloth wrinkles, below the mesh; cloth that is pulled and narrows counts too.
//
// They indicate where to look; none is a bound.
#pragma once

#include "localization/coarse_frames.h"
#include "meshes/cloth/cloth_mesh.h"
#include "verification/upsample/upsample_tables.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
/// One number per coarse triangle.
struct TriangleIndicators
{
  Eigen::VectorXd strain, change, compression; ///< (m) [-]
};

class CoarseIndicators
{
public:
  /// @param coarse its panels at rest; its positions are not used
  /// @param cell_side sqrt(|Y|) [m]
  /// @throws BadInput where the mesh at rest is not sound
  CoarseIndicators(const meshes::ClothMesh &coarse, double cell_side);

  /// Uses work space of the object: one thread at a time.
  /// @param positions (n,3) [m], finite
  TriangleIndicators of(const meshes::SpacePoints &positions) const;

  /// What single precision of the positions leaves of a stretch: 8 u max|x| over the smallest
  /// height of a triangle at rest, u = 2^-24 [-]. Compression below it is none.
  double round_off(const meshes::SpacePoints &positions) const;

  /// The row of one indicator of a frame: mean and quantile by rest area, the largest one and where
  /// it is, and what lies beyond the limit; names of frame and indicator are left to the caller.
  /// @param values one per triangle
  /// @param limit not a number where none is known
  UpsampleRow row_of(const Eigen::VectorXd &values, double limit,
                     const meshes::SpacePoints &positions) const;

private:
  const meshes::ClothMesh coarse;
  const double cell_side;
  const localization::CoarseFrames<3> frames;
  const Eigen::VectorXi space_of_rest;
  const Eigen::VectorXd areas;                              ///< (m) at rest [m^2]
  std::vector<Eigen::Matrix<double, 2, 3>> shape_gradients; ///< of the corners' hat functions [1/m]
  double smallest_height = 0.;                              ///< of a triangle at rest [m]
};
} // namespace homespun::verification
