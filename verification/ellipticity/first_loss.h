// SPDX-License-Identifier: MIT
// The strain at which a cloth of one stiffness stops being elliptic along a path of states.
#pragma once

#include "verification/law/laws.h"

#include <Eigen/Core>

#include <functional>
#include <limits>

namespace homespun::verification
{
/// In place of a strain: ellipticity is kept.
constexpr double never = std::numeric_limits<double>::infinity();

/// The first strain of a path at which ellipticity is lost, by steps of a tenth from a hundredth of
/// a thousandth on and bisection to round-off.
/// @param gradient deformation gradient (2,2) at a strain >= 0
/// @param largest strain that is looked at
/// @return the strain, or `never`
double first_loss(Law law, const Eigen::Matrix3d &C,
                  const std::function<Eigen::Matrix2d(double strain)> &gradient, double largest);

/// Which way a cloth is loaded along an axis.
enum class Direction
{
  tension,
  compression
};

/// The deformation gradient of a cloth that is loaded along an axis, its sides free of normal
/// stress. The axes stay at a right angle: of a stiffness without C16 and C26 that is all; of
/// another the angle would run away near the loss, where its resistance ends.
/// @param axis 1 or 2
/// @param strain >= 0, of either direction
/// @throws NotConverged where the sides do not become free of stress
Eigen::Matrix2d uniaxial_gradient(Law law, const Eigen::Matrix3d &C, int axis, Direction direction,
                                  double strain);

/// First loss under that load, up to 100 % of tension or 50 % of compression.
double uniaxial_loss(Law law, const Eigen::Matrix3d &C, int axis,
                     Direction direction = Direction::tension);
} // namespace homespun::verification
