// SPDX-License-Identifier: MIT
// The law `yarn`: a cloth whose yarns are stretched and turned against each other.
//   e = (|f1| − 1, |f2| − 1, gamma),   W = ½ e·C·e,   f_i = F a_i,
// a1, a2 the axes of the yarns at rest (meshes/plain/yarn_axes.h), C the stiffness in them, gamma
// the angle by which the yarns have left the right angle: sin gamma = f1·f2 / (|f1| |f2|). It has
// the same C at small strain as the other laws, does not change under rotations, and a yarn that is
// pulled keeps its resistance to being turned: the plane wave along a1 that moves along a2 costs
// C66/l1² + T1/l1, positive in every tension and lost at T1 = −C66/l1, where a compressed yarn
// kinks. Compare ellipticity.h of the laws `biot` and `green`.
//
// It belongs to what has yarns. A stiffness that is alike in all directions has no axes; there the
// law is `biot`.
#pragma once

#include "meshes/plain/yarn_axes.h"
#include "verification/yarns/metric_response.h"
#include "verification/yarns/response.h"

#include <Eigen/Core>

namespace homespun::verification
{
/// The response in the plane. gamma is the signed angle there, from −pi to pi, so that a triangle
/// that is turned over costs energy, as under biot. Of a yarn without length the energy is
/// infinite, which makes a line search step back.
Response yarn_response(const meshes::YarnAxes &yarns, const Eigen::Matrix2d &F);

/// The response of a sheet in space, where the area has no sign, by E = ½ (F^T F − I).
///
/// Where yarns lie along each other the angle has no derivative; the area ratio is then taken as
/// 1e-9 of |f1| |f2|, and a yarn's length as 1e-9 at least, which keeps all values finite.
/// @param f1,f2 F a1, F a2
MetricResponse yarn_metric_response(const meshes::YarnAxes &yarns, const Eigen::Vector3d &f1,
                                    const Eigen::Vector3d &f2);

/// The same by E in the axes of the yarns.
/// @param C stiffness in them (3,3) [N/m]
MetricResponse response_in_axes(const Eigen::Matrix3d &C, const Eigen::Vector3d &f1,
                                const Eigen::Vector3d &f2);
} // namespace homespun::verification
