// SPDX-License-Identifier: MIT
// What is prescribed of an infinite cloth: of each of the components 11, 22 and 12 either the
// strain or the nominal stress. One material axis keeps its direction, which takes away the
// rotation:
//
//   axis 1:  F = (1 + e11, e12; 0, 1 + e22),   axis 2:  F = (1 + e11, 0; e12, 1 + e22).
//
// The nominal stresses are the forces per rest length that work on these strains, dW/de11 = P11,
// dW/de22 = P22, and dW/de12 = P12 or P21. With axis 1, P12 = P22 = 0 are free sides of a strip
// pulled along axis 1; with axis 2, P21 = P11 = 0 are those of one pulled along axis 2.
#pragma once

#include "verification/periodic_cell/cell_equilibrium.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The components in the order 11, 22, 12.
struct LoadControl
{
  int axis                      = 1;                       ///< keeps its direction, 1 or 2
  std::array<bool, 3> is_stress = {true, true, true};      ///< what is prescribed of a component
  Eigen::Vector3d value         = Eigen::Vector3d::Zero(); ///< strain [-] or stress [N/m]
  std::array<bool, 3> is_given  = {false, false, false};   ///< the others are free of stress

  /// Place of a component in the order F11, F12, F21, F22.
  int place(int component) const;

  /// F of strains.
  Eigen::Matrix2d gradient(const Eigen::Vector3d &strain) const;

  /// Strains of F, nominal stresses of P.
  Eigen::Vector3d strain(const Eigen::Matrix2d &F) const;
  Eigen::Vector3d stress(const Eigen::Vector4d &P) const;

  /// The loads of components whose stress is prescribed, at a part of their final value.
  DeadLoads dead_loads(double factor) const;

  /// What is prescribed, in words: "stress 11 = 50 N/m, strain 22 = 0.02, 12 free of stress".
  std::string text() const;
};

/// What a load of an infinite cloth prescribes at a strain of 1.
/// @throws BadInput where it is a load of a sheet
LoadControl load_control(const Load &load);

/// Reads `11=50`, `12=0`: the components whose stress is given, and those whose strain is.
/// @param stresses [N/m] @param strains fractions, or percentages such as `2%`
/// @param axis that keeps its direction, 1 or 2; 0: 2 where 22 alone of the normal components is
///   not zero, so that the sides of a pull along it are free, else 1
/// @throws BadInput, a message per fault: a component that there is not, or given twice, a value
///   that is no number, a strain of -1 or less, one from 0.5 on without a percent sign, nothing but
///   zeros
LoadControl load_control(const std::vector<std::string> &stresses,
                         const std::vector<std::string> &strains, int axis);
} // namespace homespun::verification
