// SPDX-License-Identifier: MIT
// The membrane laws of the moving cloth's reference, for a sheet in space: functions of the metric
// F^T F alone, with F the 3x2 derivative of the position by the rest position. Written apart from
// the coarse cloth's element, which works with the closed form of U: here the matrix square root is
// differentiated in its own eigenvectors.
//
// All are functions of E = ½ (F^T F − I) (response.h), with S = dW/dE and H = d²W/dE²: a file of
// this folder has them of each law.
#pragma once

#include "verification/law/laws.h"
#include "verification/newton/tangent.h"

namespace homespun::verification
{
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
/// @param law not linear, which is no law in space, because it is not indifferent to rotations
/// @param C membrane stiffness (3,3) [N/m], Voigt 11, 22, 12 with engineering shear
SpaceResponse space_response(Law law, const Eigen::Matrix3d &C, const SpaceGradient &F,
                             Tangent tangent);
} // namespace homespun::verification
