// SPDX-License-Identifier: MIT
// The energy of a membrane of two families of yarns that does not carry compression, the law
// `yarn-tension`: that of yarn_energy.h, relaxed by wrinkles that are finer than any triangle.
//
// A sheet may have more length than the triangle shows, hidden in wrinkles: its own metric is then
// g + A with a positive semi-definite A, g = F^T F, and of all of them it takes the one that costs
// least (Pipkin, "Relaxed energy densities for large deformations of membranes", IMA J. Appl. Math.
// 52, 1994):
//   W_r(g) = min over A >= 0 of W(g + A),   S = 2 dW/dg there,   S >= 0 and S A = 0.
//
//   taut      A = 0, where S(g) has no compression: the law is `yarn`
//   wrinkled  A = w w^T, S w = 0: pulled along the wrinkles, free across them
//   slack     g + A = I, where all principal stretches are below 1: no energy, no stress
//
// w is a third component of the deformation, which the fine scale is free to choose: (F; w^T) is a
// sheet in space of the law `yarn`, in equilibrium along w. So the gradient of W_r is that of W at
// (F; w^T) without its last row (envelope theorem), and its second derivative the Schur complement
// of the last row's,
//   W_r'' = W_FF − W_Fw W_ww^-1 W_wF.
// W_r has one derivative everywhere, two apart from the borders between the states, and does not
// change under rotations. A principal stress is never negative, so that waves out of the plane cost
// nothing or more. The metric has no sign: a triangle that is turned over in its plane costs no
// more than one that is not, as a sheet that may leave the plane turns over there.
//
// Written apart from verification/yarns/tension_field.h, which it must equal.
#pragma once

#include "meshes/plain/yarn_axes.h"
#include "shell/membrane/corotational_energy.h"

#include <Eigen/Core>

namespace homespun::shell
{
enum class TensionState
{
  taut,
  wrinkled,
  slack
};

template <int dim>
struct TensionField
{
  TensionState state = TensionState::taut;
  double energy      = 0.;           ///< W_r per rest area [J/m^2]
  DeformationGradient<dim> gradient; ///< dW_r/dF [N/m]
  GradientHessian<dim> hessian;      ///< d²W_r/dF² [N/m]
};

/// The relaxed energy with its derivatives. At rest, where all
/// three states meet, the second derivative is that of the taut one.
/// @param F (dim,2) [-]; not-a-number in gives not-a-number out
/// @param yarns axes and stiffness in them [N/m]; they are there
/// @param kind projected: the nearest positive semi-definite tangent, in the plane of the sheet;
///   out of it the tangent is S, which is so
template <int dim>
TensionField<dim> tension_field(const DeformationGradient<dim> &F, const meshes::YarnAxes &yarns,
                                Hessian kind = Hessian::exact);

/// Gradient [N] and Hessian [N/m] of a triangle's energy A W_r by its corners, from those of W_r by
/// F = x^T B, B the gradients of the shape functions.
template <int dim>
TriangleDerivatives<dim> by_corners(const RestTriangle &rest, const TensionField<dim> &field);
} // namespace homespun::shell
