// SPDX-License-Identifier: MIT
// The membrane laws of the moving cloth's reference, for a sheet in space: functions of the metric
// F^T F alone, with F the 3x2 derivative of the position by the rest position. Written apart from
// the coarse cloth's element, which works with the closed form of U: here the matrix square root is
// differentiated in its own eigenvectors.
//
// All are functions of E = ½ (F^T F − I) (metric_response.h), with S = dW/dE and H = d²W/dE².
// green: S = C E, H = C. yarn: yarn_law.h. biot: from U U = F^T F,
// in the frame of the principal stretches l1, l2,
//   dU_ij = 2 dE_ij / (l_i + l_j),   d²U_ij = −2 (dU dU)_ij / (l_i + l_j)   along straight E,
// and W = ½ (U − I):C:(U − I) follows by the chain rule. No difference l1 − l2 is divided by.
#pragma once

#include "verification/newton/tangent.h"
#include "verification/reference/laws.h"

namespace homespun::verification
{
/// Derivative of the position in space by the rest position, columns f1, f2.
using SpaceGradient = Eigen::Matrix<double, 3, 2>;
/// Second derivative by the entries of F in the order F11, F12, F21, F22, F31, F32.
using SpaceTangent = Eigen::Matrix<double, 6, 6>;

/// Energy per rest area and its derivatives by F.
struct SpaceResponse
{
  double energy;        ///< W [N/m]
  SpaceGradient stress; ///< P = dW/dF [N/m]
  SpaceTangent tangent; ///< dP/dF [N/m]
};

/// The response of a law but linear in space.
///
/// Where a triangle has collapsed to a line or a point, W of biot has no derivative; the smaller
/// stretch is then taken as 1e-9 of the larger one (or of 1), which keeps all values finite.
/// @param law not linear, which is no law in space, because it is not indifferent to rotations
/// @param C membrane stiffness (3,3) [N/m], Voigt 11, 22, 12 with engineering shear
SpaceResponse space_response(Law law, const Eigen::Matrix3d &C, const SpaceGradient &F,
                             Tangent tangent);
} // namespace homespun::verification
