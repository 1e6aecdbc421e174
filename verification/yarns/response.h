// SPDX-License-Identifier: MIT
// What a law of the plane answers at a deformation gradient.
#pragma once

#include <Eigen/Core>

namespace homespun::verification
{
/// Energy per area and its derivatives by the entries of F in the order F11, F12, F21, F22.
struct Response
{
  double energy;           ///< W [N/m]
  Eigen::Vector4d stress;  ///< P = dW/dF, the first Piola-Kirchhoff membrane force [N/m]
  Eigen::Matrix4d tangent; ///< dP/dF [N/m]
};
} // namespace homespun::verification
