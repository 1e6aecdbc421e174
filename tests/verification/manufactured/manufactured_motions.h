// SPDX-License-Identifier: MIT
// What manufactured solutions are made of: smooth motions with their derivatives, stiffnesses that
// vary smoothly, and the mesh on which all solvers are tried.
#pragma once

#include "meshes/plain/triangle_mesh.h"
#include "verification/reference/known_field.h"

#include <Eigen/Core>

#include <functional>

namespace homespun::verification
{
/// Side of every sheet and cell [m].
constexpr double manufactured_side = 0.1;

/// Of the central differences of equilibrium_force() [m].
constexpr double manufactured_difference = 2e-3 * manufactured_side;

/// Without a symmetry (3,3) [N/m].
Eigen::Matrix3d anisotropic();

/// Without contraction: a sheet stretched along axis 2 has no forces on its sides (3,3) [N/m].
Eigen::Matrix3d without_contraction();

/// A stiffness that varies by half of its size over the side, periodic with it, and changes its
/// anisotropy; without contraction where `stiffness` is [N/m].
Eigen::Matrix3d varied(const Eigen::Matrix3d &stiffness, const Eigen::RowVector2d &point);

/// An irregular mesh of n_coarsest divisions along a side, always the same one, refined until there
/// are n: were it drawn anew on each level, chance would blur the orders.
meshes::TriangleMesh irregular_mesh(int n, int n_coarsest = 6);

/// A field with its derivatives by the rest point.
struct Wave
{
  FieldValue value;       ///< [m]
  FieldGradient gradient; ///< [-]
};

/// A displacement in the plane, in proportion to the strain.
using PlaneField = Wave (*)(const Eigen::RowVector2d &point, double strain);

/// Periodic with the sheet, of no symmetry; strains of up to 0.7 times `strain` beside the mean
/// one.
Wave periodic_wave(const Eigen::RowVector2d &point, double strain);

/// Zero where the sheet is clamped; zero with its derivatives on the free sides.
Wave clamped_wave(const Eigen::RowVector2d &point, double strain);

/// Positions of a sheet in space: stretched in its plane, and a bump of a height with a shift
/// inside the sheet. Its rim stays.
/// @param height over the side
Wave bulging(const Eigen::RowVector2d &point, double height);

/// Of a bump that is seen well.
constexpr double full_height = 0.25;

/// Positions of a sheet in space: turned and stretched, and a bump whose slope and curvature vanish
/// at the rim.
Wave spreading(const Eigen::RowVector2d &point);

/// A motion through time.
using SheetMotion = std::function<Wave(const Eigen::RowVector2d &point, double time)>;

/// What it is at a time.
KnownField at_time(const SheetMotion &motion, double time);
} // namespace homespun::verification
