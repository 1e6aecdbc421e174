// SPDX-License-Identifier: MIT
// The strains of the sides of a cloth without a microstructure that is pulled along one axis.
#pragma once

#include "verification/law/laws.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <functional>

namespace homespun::verification
{
/// e and g that make the sides free of stress, by Newton's method from linear theory.
/// @param load one with free sides
/// @param C (3,3) [N/m]
/// @throws NotConverged with the residual history
Eigen::Vector2d free_strains_of(const Load &load, Law law, const Eigen::Matrix3d &C, double strain);

/// The same under any law.
/// @param law the response at a deformation gradient; a tangent that is not exact costs steps
/// @param C the stiffness at rest (3,3) [N/m]
Eigen::Vector2d free_strains_of(const Load &load,
                                const std::function<Response(const Eigen::Matrix2d &F)> &law,
                                const Eigen::Matrix3d &C, double strain);
} // namespace homespun::verification
