// SPDX-License-Identifier: MIT
// The membrane between two states x0 and x1 of a conserving step: forces on a triangle whose work
// over the step is the change of its energy, whatever the step.
//
// W = ½ e·D·e is quadratic in U, and U² = C = F^T F is quadratic in the positions. With means over
// the step,
//   C1 − C0 = Ū (U1 − U0) + (U1 − U0) Ū = 2 sym(F̄^T (F1 − F0))
//   W1 − W0 = T̄ : (U1 − U0),   T̄ = D ē,
// so that the second Piola-Kirchhoff stress S of Ū S + S Ū = 2 T̄ does the work ½ S : (C1 − C0) =
// W1 − W0, exactly: no quotient of small differences. The forces A F̄ S g of hats with the
// gradients g sum to zero and have no torque about the mean positions, because S is symmetric. This
// is a discrete gradient (Gonzalez, "Time integration and discrete Hamiltonian systems", J.
// Nonlinear Sci. 6, 1996) in the form of an algorithmic stress (Simo and Tarnow, "The discrete
// energy-momentum method", ZAMP 43, 1992).
#pragma once

#include "shell/algebra/block_matrix.h"
#include "shell/membrane/corotational_energy.h"

#include <Eigen/Core>

namespace homespun::shell
{
class VertexMatrix;

/// How the Biot stress of a step comes from the strains at its ends, T̄ = D (old e0 + now e1): ½, ½
/// for an elastic membrane; −β/h, β/h for a viscosity β, whose work β/h (e1 − e0)·D·(e1 − e0) is
/// never negative.
struct StrainWeights
{
  double old = 0.5, now = 0.5;
};

/// What a triangle does over a step.
struct TriangleStep
{
  Eigen::Matrix3d gradient;             ///< row k: of corner k; the force is its negative [N]
  Eigen::Matrix<double, 9, 9> jacobian; ///< of gradient by the new corners, unknown 3 k + i [N/m]
};

/// The forces A F̄ S g and their derivative, with S and its derivative by the metric at the end:
/// what every law of a triangle ends in.
/// @param hats gradients g, row k: of corner k, along the two directions that F maps [1/m]
/// @param mean,F columns of the deformation gradient: means over the step, and at its end
/// @param S (2,2) [N/m]
/// @param dS of S11, S22, S12 by C11/2, C22/2, C12 at the end of the step [N/m]
TriangleStep step_of_stress(double area, const Eigen::Matrix<double, 3, 2> &hats,
                            const DeformationGradient<3> &mean, const DeformationGradient<3> &F,
                            const Eigen::Matrix2d &S, const Eigen::Matrix3d &dS);

/// Forces over a step and their derivative, which is not symmetric. Where both ends of the step are
/// collapsed to the same line, S across it is zero: no force depends on it.
/// @param old_corners,corners (3,3) at the beginning and at the end [m]
/// @param D (3,3) [N/m]
TriangleStep triangle_step(const RestTriangle &rest, const Eigen::Matrix3d &old_corners,
                           const Eigen::Matrix3d &corners, const Eigen::Matrix3d &D,
                           const StrainWeights &weights);

/// Adds what a triangle does to those of all.
/// @param vertices its corners
void add_step(const TriangleStep &step, const Eigen::RowVector3i &vertices, Vectors &gradient,
              VertexMatrix &jacobian);
} // namespace homespun::shell
