// SPDX-License-Identifier: MIT
// The law `yarn-tension`: yarn_law.h for a cloth that cannot be pressed. Wrinkles finer than any
// triangle hide length, so that the cloth's own metric is D = C + A, C = F^T F, with a positive
// semi-definite A, the one that costs least (Pipkin, "Relaxed energy densities for large
// deformations of membranes", IMA J. Appl. Math. 52, 1994):
//   W(C) = min over A >= 0 of W_yarn(C + A),   with S = dW_yarn/dE there: S >= 0, S A = 0.
// Taut where S(C) has no pressure: the law is `yarn`. Slack where no stretch exceeds 1: D = I, and
// nothing is carried. Wrinkled between: A = w w^T with S w = 0, a pull along the wrinkles alone.
//
// With m = w/|w|, t across it, α = |w|² and sigma = t·S t, small changes of A are p m m^T +
// r (m t^T + t m^T)/√α, and the stiffness of D = C + A under them is condensed out:
//   H = H_yarn − H_yarn V M^-1 V^T H_yarn,   M = V^T H_yarn V + diag(0, 4 sigma),
//   V = (m m^T, √α (m t^T + t m^T)) in Voigt order.
// Where wrinkles begin, α = 0, H jumps; W and S do not. In the plane a triangle that is turned over
// costs no more than one that is not.
#pragma once

#include "meshes/plain/yarn_axes.h"
#include "verification/yarns/metric_response.h"
#include "verification/yarns/response.h"

#include <Eigen/Core>

namespace homespun::verification
{
/// How a cloth lies that cannot be pressed.
enum class ClothState
{
  taut,
  wrinkled,
  slack
};

struct TensionField
{
  ClothState state;
  MetricResponse response; ///< by E of F
};

/// @param C F^T F (2,2)
/// @param yarns they are there
TensionField tension_field(const meshes::YarnAxes &yarns, const Eigen::Matrix2d &C);

/// The response in the plane.
Response tension_response(const meshes::YarnAxes &yarns, const Eigen::Matrix2d &F);

/// The state of a phase at a gradient; one without axes is taut.
/// @param stiffness (3,3) [N/m]
ClothState cloth_state(const Eigen::Matrix3d &stiffness, const Eigen::Matrix2d &F);
} // namespace homespun::verification
