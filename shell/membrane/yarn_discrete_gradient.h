// SPDX-License-Identifier: MIT
// The membrane of yarns between two states x0 and x1 of a conserving step: forces on a triangle
// whose work over the step is the change of its energy, whatever the step; discrete_gradient.h for
// the law of yarn_energy.h.
//
// W = ½ e·C·e is quadratic in e = (l1 − 1, l2 − 1, gamma), so that W1 − W0 = T̄·(e1 − e0) with
// T̄ = C ē, means being those of the two ends. And e1 − e0 = M (E1 − E0) exactly, by the metric
// g_ij = f_i·f_j in E = (½ (g11 − 1), ½ (g22 − 1), g12), one product at a time:
//   Δl_i    = ΔE_ii / l̄_i,          Δ(1/l_i) = −Δl_i / (l_i0 l_i1),
//   Δsin γ  = Δ(g12 / (l1 l2)),      Δ(a b)   = ā Δb + b̄ Δa,
//   Δγ      = Δsin γ / (cos γ̄ · sin h / h),   h = ½ Δγ.
// The second Piola-Kirchhoff stress S = M^T T̄ is symmetric, and ΔE = sym(F̄^T ΔF): the forces
// A F̄ S g of hats with the gradients g do the work W1 − W0, sum to zero and have no torque about
// the mean positions. At x0 = x1, M is the derivative of the strain, and S the stress.
#pragma once

#include "meshes/plain/yarn_axes.h"
#include "shell/membrane/discrete_gradient.h"

#include <Eigen/Core>

namespace homespun::shell
{
/// Forces over a step and their derivative. Not a number where a yarn has no length at either end
/// of the step, or the yarns lie along each other at both, the same way round: there the law has
/// no finite energy, or no derivative.
/// @param old_corners,corners (3,3) at the beginning and at the end [m]
TriangleStep yarn_triangle_step(const RestTriangle &rest, const Eigen::Matrix3d &old_corners,
                                const Eigen::Matrix3d &corners, const meshes::YarnAxes &yarns);
} // namespace homespun::shell
