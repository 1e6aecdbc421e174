// SPDX-License-Identifier: MIT
// Manufactured solutions: a smooth motion is chosen, and the body force that makes it an
// equilibrium or a motion is computed from it,
//   f = −Div P(F)                 statics,    P = dW/dF,  (Div P)_i = dP_ij/dX_j
//   f = rho x'' − Div P(F)        dynamics    per rest area
// so that a solver's distance from it has the order of its elements and nothing else (Roache, J.
// Fluids Eng. 124, 2002).
//
// The energies are written here once more, from their formulas alone: P by complex steps in F^T F,
// which are exact to round-off, Div P by central differences of fourth order. Nothing is shared
// with the laws that the solvers use, neither stress nor tangent.
#pragma once

#include "verification/law/laws.h"

#include <Eigen/Core>

#include <functional>

namespace homespun::verification
{
/// F of a motion at a rest point.
using GradientField =
  std::function<Eigen::Matrix<double, 3, 2>(const Eigen::RowVector2d &rest_point)>;

/// The stiffness at a rest point (3,3) [N/m].
using StiffnessField = std::function<Eigen::Matrix3d(const Eigen::RowVector2d &rest_point)>;

/// Energy per rest area of a law at a gradient F, and its stress P = dW/dF.
struct EnergyAndStress
{
  double energy;                      ///< W [N/m]
  Eigen::Matrix<double, 3, 2> stress; ///< P [N/m]
};

/// W and P from the formula of the law. biot: U = (C + sqrt(det C) I) / sqrt(tr C + 2 sqrt(det C))
/// with C = F^T F. linear: the in-plane part of F. yarn: stretches and angle by C in axes along the
/// largest Young's modulus; the stiffness must have some.
/// @param stiffness (3,3) [N/m], Voigt 11, 22, 12 with engineering shear
EnergyAndStress energy_and_stress(Law law, const Eigen::Matrix3d &stiffness,
                                  const Eigen::Matrix<double, 3, 2> &F);

/// −Div P of a motion, per rest area [N/m^2].
/// @param stiffness smooth within two steps of the point; layers are asked for one by one
/// @param gradient F of the motion; in the plane its third row is zero
/// @param step of the central differences [m], some thousandth of the length on which the motion
///   varies
Eigen::Vector3d equilibrium_force(Law law, const StiffnessField &stiffness,
                                  const GradientField &gradient,
                                  const Eigen::RowVector2d &rest_point, double step);

/// The same of one stiffness everywhere.
Eigen::Vector3d equilibrium_force(Law law, const Eigen::Matrix3d &stiffness,
                                  const GradientField &gradient,
                                  const Eigen::RowVector2d &rest_point, double step);
} // namespace homespun::verification
