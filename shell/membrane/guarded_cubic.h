// SPDX-License-Identifier: MIT
// The cubic energy of a homogenized cell beside its quadratic one, so that the coarse cloth is
// right at second order in strain: W = ½ e.C.e + G(e), e the Biot strain (corotational_energy.h).
//
// A cubic form has no lower bound, and its second derivative outgrows C. G is the form W3 itself
// where it is small beside C, and beyond that is damped so that every strain, of any size, keeps at
// least a tenth of the stiffness:  d²W/de² >= C/10  as quadratic forms.
//
// How. With |e| = sqrt(e.C.e) and tau the largest |T(u,u,u)| of |u| = 1, T the third derivative of
// W3, |d²W3| <= tau |e| C (Banach: a symmetric form is largest where its arguments agree). With
// r0 = 1/(3 tau) and x = |e|/r0,
//   G = W3(e) P(x)/x³,   P = x³ up to 1, −2 x³ + 9 x² − 9 x + 3 up to 3/2, (18 x − 15)/4 beyond:
// along every ray the second derivative falls to zero between r0 and 3/2 r0, continuously, and from
// there on G grows linearly. With A = P/x², B = P'/x the second derivative of G, in the metric of
// C, is r0 A times that of W3 at the unit strain, at most tau r0 A, and a rest whose entries along
// the ray, across it and mixed are (P'' − 6 A) t, (B − 3 A) t and (B − 3 A) t' with t = W3(u) and
// t' its derivative on the sphere; t² + t'²/9 <= (tau/6)² (Bernstein and Szegő: t is a
// trigonometric polynomial of degree 3 on great circles). The sum is largest at x = 5/3, 2.7 tau r0
// = 0.9.
#pragma once

#include "meshes/plain/cubic_form.h"
#include "shell/membrane/corotational_energy.h"

#include <Eigen/Core>

namespace homespun::shell
{
/// G of one phase: value, gradient and Hessian by e. Stateless after its construction.
class GuardedCubic
{
public:
  /// @param energy W3 [N/m]
  /// @param stiffness C (3,3), symmetric positive definite [N/m]
  GuardedCubic(const meshes::CubicForm &energy, const Eigen::Matrix3d &stiffness);

  /// G per rest area [N/m].
  double value(const Eigen::Vector3d &strain) const;

  /// dG/de [N/m].
  Eigen::Vector3d gradient(const Eigen::Vector3d &strain) const;

  /// d²G/de² (3,3) [N/m].
  Eigen::Matrix3d hessian(const Eigen::Vector3d &strain) const;

  /// Both derivatives, for the price of the second.
  struct Derivatives
  {
    Eigen::Vector3d gradient;
    Eigen::Matrix3d hessian;
  };
  Derivatives derivatives(const Eigen::Vector3d &strain) const;

  /// Whether G is W3 itself at a strain.
  bool is_trusted(const Eigen::Vector3d &strain) const;

  /// r0: up to which sqrt(e.C.e) this is so [sqrt(N/m)]; infinite of a form that is zero.
  double reach() const
  {
    return r0;
  }

private:
  struct Damping;
  Damping damping(double size) const;

  meshes::CubicForm energy;
  Eigen::Matrix3d C;
  double r0;
};

/// A triangle's law at one strain as a quadratic energy with an initial stress: what
/// triangle_derivatives() takes, and gives the derivatives of ½ e.D.e + T0.e + G(e) with.
struct TangentLaw
{
  MembraneStiffness stiffness;    ///< D + d²G/de²
  Eigen::Vector3d initial_stress; ///< T0 + dG/de − d²G/de² e [N/m]
};

/// @param D (3,3) [N/m]
/// @param initial_stress T0 [N/m]
/// @param strain e
TangentLaw tangent_law(const Eigen::Matrix3d &D, const GuardedCubic &cubic,
                       const Eigen::Vector3d &strain, const Eigen::Vector3d &initial_stress);
} // namespace homespun::shell
