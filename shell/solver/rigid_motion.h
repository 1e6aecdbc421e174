// SPDX-License-Identifier: MIT
// The rigid part of a cloth's motion: momenta, and the velocities of a rigid body in its place.
#pragma once

#include "shell/algebra/block_matrix.h"

#include <Eigen/Core>

namespace homespun::shell
{
/// Σ m x / Σ m [m].
Eigen::RowVector3d centre_of_mass(const Eigen::VectorXd &masses, const Vectors &positions);

/// Σ m (x − centre) × v [kg m²/s].
Eigen::RowVector3d angular_momentum(const Eigen::VectorXd &masses, const Vectors &positions,
                                    const Vectors &velocities);

/// Angular velocity [1/s] of a rigid body in the place of the cloth with the given angular momentum
/// about its centre of mass [kg m²/s]. A cloth collapsed to a line cannot turn about it.
Eigen::RowVector3d spin_of(const Eigen::VectorXd &masses, const Vectors &positions,
                           const Eigen::RowVector3d &angular_momentum);

/// How an integrator turns a rigid body about its axis in a step: implicit Euler by atan(h ω), the
/// midpoint rule by 2 atan(h ω/2).
enum class RigidStep
{
  implicit_euler,
  midpoint
};

/// Where the cloth is after the time h if it moves on as a rigid body with its momenta.
Vectors moved_rigidly(const Eigen::VectorXd &masses, const Vectors &positions,
                      const Vectors &velocities, double h, RigidStep kind);
} // namespace homespun::shell
