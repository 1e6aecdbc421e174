// SPDX-License-Identifier: MIT
// The energy of a membrane triangle of two families of yarns, the law `yarn`:
//   W = ½ e·C·e per rest area,  e = (l1 − 1, l2 − 1, gamma),  l_i = |f_i|,  f_i = F a_i,
// a1, a2 the axes of the stiffness and C the stiffness in them (meshes/plain/yarn_axes.h), gamma
// the angle by which the yarns have left the right angle. It has the stiffness of
// corotational_energy.h at rest, and keeps ellipticity in tension, where that loses it.
//
// With T = C e and the frames of the yarns, t_i = f_i/l_i along, n_i across it in the plane of the
// sheet, n across that: for df_i = α_i t_i + β_i n_i + ζ_i n
//   dl_i = α_i,   dgamma = β1/l1 − β2/l2,
//   d²W  = de·C·de + Σ T_i β_i²/l_i − 2 T3 (α1 β1/l1² − α2 β2/l2²)
//        + Σ T_i ζ_i²/l_i + T3 (2 z1 z2/cos gamma − (z1² + z2²) tan gamma),   z_i = ζ_i/l_i:
// the second derivative falls apart into 4 x 4 in the plane and 2 x 2 out of it.
//
// dim = 2: gamma has its sign, from −pi to pi, so that a triangle that is turned over costs energy.
// dim = 3: gamma from −pi/2 to pi/2; a sheet in space has no sign. Where the yarns lie along each
//   other the normal is undefined and gamma has a kink; we take zero from its subdifferential.
//
// Of a yarn without length the energy is infinite, which makes a line search step back, and the
// derivatives are zero. All functions are stateless. Not-a-number in gives not-a-number out.
//
// Written apart from verification/law/laws.h, which it must equal.
#pragma once

#include "meshes/plain/yarn_axes.h"
#include "shell/membrane/corotational_energy.h"

#include <Eigen/Core>

namespace homespun::shell
{
/// Strain e = (l1 − 1, l2 − 1, gamma) [-, -, rad]; not a number of a yarn without length.
/// @param F (dim,2) [-]
template <int dim>
Eigen::Vector3d yarn_strain(const DeformationGradient<dim> &F, const meshes::YarnAxes &yarns);

/// Whether both yarns have a length, so that the energy is finite.
template <int dim>
bool has_length(const DeformationGradient<dim> &F, const meshes::YarnAxes &yarns);

/// Energy W = ½ e·C·e per rest area.
/// @param F (dim,2) [-]
/// @param yarns axes and stiffness in them [N/m]; they are there
/// @return [J/m^2]
template <int dim>
double yarn_energy_density(const DeformationGradient<dim> &F, const meshes::YarnAxes &yarns);

/// First Piola-Kirchhoff stress P = dW/dF.
/// @return (dim,2) [N/m]
template <int dim>
DeformationGradient<dim> yarn_energy_gradient(const DeformationGradient<dim> &F,
                                              const meshes::YarnAxes &yarns);

/// Tangent d²W/dF². Projected it is the nearest positive semi-definite one: both parts lose their
/// negative eigenvalues, and one that has none is not changed.
/// @return (2 dim, 2 dim) [N/m]
template <int dim>
GradientHessian<dim> yarn_energy_hessian(const DeformationGradient<dim> &F,
                                         const meshes::YarnAxes &yarns,
                                         Hessian kind = Hessian::exact);

/// Gradient of a triangle's energy, area times W, by its corners.
/// @param corners (3,dim) current positions [m]
/// @return (3,dim) [N]
template <int dim>
Eigen::Matrix<double, 3, dim> yarn_triangle_gradient(const RestTriangle &rest,
                                                     const Eigen::Matrix<double, 3, dim> &corners,
                                                     const meshes::YarnAxes &yarns);

/// Gradient and Hessian of a triangle's energy in one pass.
/// @param corners (3,dim) current positions [m]
template <int dim>
TriangleDerivatives<dim>
yarn_triangle_derivatives(const RestTriangle &rest, const Eigen::Matrix<double, 3, dim> &corners,
                          const meshes::YarnAxes &yarns, Hessian kind = Hessian::exact);
} // namespace homespun::shell
