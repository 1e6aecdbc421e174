// SPDX-License-Identifier: MIT
// A place of the cloth that is held, and how it moves.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
/// How a held part of the cloth moves.
struct Motion
{
  enum class Kind
  {
    rest,
    translate,
    rotate
  };
  Kind kind = Kind::rest;
  Eigen::RowVector3d along =
    Eigen::RowVector3d::Zero(); ///< translation [m], or axis of the rotation
  double angle   = 0.;          ///< [rad]
  double seconds = 0.;          ///< from the beginning on, evenly accelerated and braked
};

/// A place that is held: `left`, `right`, `bottom`, `top` edge or a corner such as `top left` of a
/// sheet; `waist`, the vertices of a garment that begin highest; `vertices 0 1 2` of the coarse
/// cloth.
struct HeldPlace
{
  std::string place;
  std::vector<int> vertices; ///< of `vertices ...`
  Motion motion;
};
} // namespace homespun::verification
