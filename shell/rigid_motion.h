// SPDX-License-Identifier: MIT
// The rigid part of a cloth's motion: momenta, and the velocities of a rigid body in its place.
#pragma once

#include "shell/block_matrix.h"

#include <Eigen/Core>

namespace homespun::shell
{
/// Σ m x / Σ m [m].
Eigen::RowVector3d centre_of_mass(const Eigen::VectorXd &masses, const Vectors &positions);

/// Σ m (x − centre) × v [kg m²/s].
Eigen::RowVector3d angular_momentum(const Eigen::VectorXd &masses, const Vectors &positions,
                                    const Vectors &velocities);

/// Angular velocity [1/s] of a rigid body in the place of the cloth with the given angular momentum about
/// its centre of mass [kg m²/s]. A cloth collapsed to a line cannot turn about it.
Eigen::RowVector3d spin_of(const Eigen::VectorXd &masses, const Vectors &positions,
                           const Eigen::RowVector3d &angular_momentum);

/// Adds spin × (x − centre) to the velocities [m/s].
void add_spin(const Eigen::VectorXd &masses, const Vectors &positions,
              const Eigen::RowVector3d &spin, Vectors &velocities);

/// Where the cloth is after the time h if it moves on as a rigid body with its momenta: turned by h ω about the centre of
/// mass, with the angular velocity ω of half way, so that the energy of the body changes by O(h³) alone.
Vectors moved_rigidly(const Eigen::VectorXd &masses, const Vectors &positions,
                      const Vectors &velocities, double h);
} // namespace homespun::shell
