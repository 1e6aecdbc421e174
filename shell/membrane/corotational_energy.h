// SPDX-License-Identifier: MIT
// The exact corotational energy of a membrane triangle,
//   W = ½ e·D·e per rest area,  e = (U11 − 1, U22 − 1, 2 U12),  U = sqrt(F^T F),
// with any symmetric positive definite stiffness D [N/m] (Voigt 11, 22, 12, engineering shear), and
// its exact gradient and Hessian: in place of paper Eqs. 5-8, whose warped forces are no gradient
// (shell/README.md). W is what a corotational element approximates and equals the reference law
// `biot`.
//
// In closed form, with C = F^T F and the area ratio J,
//   U = (C + J I) / s,   s = tr U = sqrt(tr C + 2 J).
// dim = 3: J = |f1 × f2| >= 0, a sheet in space has no sign. Where a triangle is collapsed to a
//   line the normal is undefined; J has a kink there and we take zero from its subdifferential.
// dim = 2: J = det F with its sign, so that U = R^T F with the rotation R nearest to F, det R = +1.
//   For det F > 0 this is sqrt(F^T F). Where a triangle is inverted, sqrt(F^T F) would not see it
//   (a mirrored triangle would be at rest); R^T F has a negative eigenvalue, costs energy and
//   pushes back, and is smooth through the collapse.
// Where s = 0 (a point; in the plane also a scaled reflection) R is undefined: the value and the
//   derivatives are those of R frozen at the identity: finite, symmetric, and a way out.
// All functions are stateless. Not-a-number in gives not-a-number out.
#pragma once

#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/Core>

#include <array>

namespace homespun::shell
{
/// Derivative of the current position with respect to the rest position, columns f1, f2.
template <int dim>
using DeformationGradient = Eigen::Matrix<double, dim, 2>;

/// Second derivative with respect to F, whose entries stand column by column: f1, then f2.
template <int dim>
using GradientHessian = Eigen::Matrix<double, 2 * dim, 2 * dim>;

/// Whether a Hessian is exact, or its element contributions are made positive semi-definite: the
/// geometric term out of the plane keeps its tension only, and in the plane the stiffness against
/// turning is raised to the least value that makes the 4 x 4 form positive semi-definite (a Schur
/// complement, one number). A Hessian that is positive semi-definite is not changed.
enum class Hessian
{
  exact,
  projected
};

/// Biot strain e = (U11 − 1, U22 − 1, 2 U12) in the sheet's own frame.
/// @param F (dim,2) [-]
template <int dim>
Eigen::Vector3d biot_strain(const DeformationGradient<dim> &F);

/// Energy W = ½ e·D·e per rest area.
/// @param F (dim,2) [-]
/// @param D (3,3) symmetric positive definite [N/m]
/// @return [J/m^2]
template <int dim>
double energy_density(const DeformationGradient<dim> &F, const Eigen::Matrix3d &D);

/// First Piola-Kirchhoff stress P = dW/dF.
/// @param F (dim,2) [-]
/// @param D (3,3) [N/m]
/// @param initial_stress T0 [N/m]: the gradient of W + T0·e
/// @return (dim,2) [N/m]
template <int dim>
DeformationGradient<dim>
energy_gradient(const DeformationGradient<dim> &F, const Eigen::Matrix3d &D,
                const Eigen::Vector3d &initial_stress = Eigen::Vector3d::Zero());

/// Tangent d²W/dF², by default exact.
/// @param F (dim,2) [-]
/// @param D (3,3) [N/m]
/// @return (2 dim, 2 dim) [N/m]
template <int dim>
GradientHessian<dim> energy_hessian(const DeformationGradient<dim> &F, const Eigen::Matrix3d &D,
                                    Hessian kind = Hessian::exact);

/// A membrane stiffness [N/m] and its inverse, which the projected Hessian asks for.
struct MembraneStiffness
{
  MembraneStiffness(const Eigen::Matrix3d &D); // NOLINT: a stiffness is a matrix
  Eigen::Matrix3d D, inverse;
};

/// What an element keeps of its rest triangle.
using RestTriangle = meshes::TriangleGeometry;

/// The rest triangle with the given corners, counter-clockwise.
/// @param corners (3,2) [m], of positive area
RestTriangle rest_triangle(const Eigen::Matrix<double, 3, 2> &corners);

/// Deformation gradient of a triangle, F = [x1 − x0, x2 − x0] Dm^-1 (paper Eqs. 10-11, whose
/// printed Q is the inverse of this).
/// @param corners (3,dim) current positions [m]
template <int dim>
DeformationGradient<dim> deformation_gradient(const RestTriangle &rest,
                                              const Eigen::Matrix<double, 3, dim> &corners);

/// Energy of a triangle, area times W [J].
template <int dim>
double triangle_energy(const RestTriangle &rest, const Eigen::Matrix<double, 3, dim> &corners,
                       const Eigen::Matrix3d &D);

/// Gradient of triangle_energy() with respect to the corners; the elastic force is its negative.
/// @return (3,dim) [N]
template <int dim>
Eigen::Matrix<double, 3, dim> triangle_gradient(const RestTriangle &rest,
                                                const Eigen::Matrix<double, 3, dim> &corners,
                                                const Eigen::Matrix3d &D);

/// Gradient and Hessian of a triangle, for assembly by blocks.
template <int dim>
struct TriangleDerivatives
{
  Eigen::Matrix<double, 3, dim> gradient; ///< [N]
  /// Blocks of the corners (0,0) (0,1) (0,2) (1,1) (1,2) (2,2) [N/m].
  std::array<Eigen::Matrix<double, dim, dim>, 6> blocks;
};

/// Gradient and Hessian of triangle_energy() in one pass.
/// @param initial_stress T0 [N/m]: derivatives of area (½ e·D·e + T0·e)
template <int dim>
TriangleDerivatives<dim>
triangle_derivatives(const RestTriangle &rest, const Eigen::Matrix<double, 3, dim> &corners,
                     const MembraneStiffness &stiffness, Hessian kind = Hessian::exact,
                     const Eigen::Vector3d &initial_stress = Eigen::Vector3d::Zero());

/// Hessian of triangle_energy(); component i of corner k is unknown k dim + i.
/// @return (3 dim, 3 dim) [N/m]
template <int dim>
Eigen::Matrix<double, 3 * dim, 3 * dim>
triangle_hessian(const RestTriangle &rest, const Eigen::Matrix<double, 3, dim> &corners,
                 const MembraneStiffness &stiffness, Hessian kind = Hessian::exact,
                 const Eigen::Vector3d &initial_stress = Eigen::Vector3d::Zero());
} // namespace homespun::shell
