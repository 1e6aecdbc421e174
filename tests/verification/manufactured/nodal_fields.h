// SPDX-License-Identifier: MIT
// Integrals over linear triangles without a finite-element library: the consistent loads of a body
// force, and the distance of a cloth's positions from a known motion. field_integrals.h does the
// same for the references.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "verification/reference/known_field.h"

#include <Eigen/Core>

#include <functional>

namespace homespun::verification
{
/// Integral of f N_i for every vertex, by a formula of degree 4 (n,3) [N].
/// @param force per rest area [N/m^2]
meshes::SpacePoints
nodal_loads(const meshes::TriangleMesh &rest,
            const std::function<FieldValue(const Eigen::RowVector2d &rest_point)> &force);

/// The distance of positions that are linear in each triangle from a known motion, by a formula of
/// degree 4.
/// @param positions (n,3) [m]
FieldDistance distance(const meshes::TriangleMesh &rest, const meshes::SpacePoints &positions,
                       const KnownField &known);

/// The gradients of the three shapes of a triangle by the rest point, rows (3,2) [1/m].
Eigen::Matrix<double, 3, 2> shape_gradients(const meshes::TriangleMesh &rest, int triangle);
} // namespace homespun::verification
