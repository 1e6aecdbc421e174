// SPDX-License-Identifier: MIT
// Bars of moduli, which belong to the inverse of a stiffness.
#pragma once

#include "homogenization/fem/homogenize.h"
#include "verification/record/verdict.h"

#include <Eigen/Core>

#include <string>

namespace homespun::verification
{
/// How far an entry of a compliance between the inverses of both sides of a stiffness may be from
/// the exact one: with G their difference |S_ij − S^H_ij| <= sqrt(G_ii G_jj).
Eigen::Matrix3d compliance_bars(const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper);

/// Bars of moduli from those of the compliance S.
homogenization::EngineeringConstants bars_of_moduli(const Eigen::Matrix3d &S,
                                                    const Eigen::Matrix3d &bars);

/// The claim that bars of moduli hold: the largest distance of a modulus from that which is said of
/// a stiffness, over its bar, where each entry of the compliance lies at an end of its own bar, and
/// of both sides, is 1 by definition. Round-off of a modulus and of the inverse counts as a part of
/// its bar; infinite bars hold everything.
/// @param name of the stiffness whose moduli have the bars
Verdict check_of_moduli(const std::string &name, const Eigen::Matrix3d &stiffness,
                        const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper);
} // namespace homespun::verification
