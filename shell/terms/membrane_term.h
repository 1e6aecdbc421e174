// SPDX-License-Identifier: MIT
// The membrane of a moving cloth: the exact energy of corotational_energy.h, with an optional
// viscosity in the rate of strain.
//
//   E = Σ_triangles A ( ½ e·D·e + β/(2h) (e − e_n)·D·(e − e_n) ),   e = U − I in Voigt form,
//
// e_n being the strain when the step begins. The viscous part depends on strains alone, so that it
// damps no rigid motion and keeps both momenta, unlike a damping by the stiffness matrix.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/membrane/membrane.h"
#include "shell/terms/term.h"

#include <memory>

namespace homespun::shell
{
/// @param stiffness one symmetric positive definite matrix (3,3) per phase, cloth.rest.material
///   [N/m]
/// @param viscosity β: stress D·de/dt times this [s]
/// @param cubic energies of third order, one per phase (add_cubic_energy()); none: e·D·e alone. A
///   term with them has no discrete gradient.
/// @throws BadInput as membrane() does, and where the viscosity is negative
std::unique_ptr<Term> membrane_term(const meshes::ClothMesh &cloth,
                                    const std::vector<Eigen::Matrix3d> &stiffness,
                                    double viscosity                            = 0.,
                                    const std::vector<meshes::CubicForm> &cubic = {});

/// The viscous part of E alone, for a cloth whose elasticity is that of another term (warping.h).
/// @param viscosity β > 0 [s]
/// @throws BadInput as membrane_term() does, and where the viscosity is zero
std::unique_ptr<Term> viscosity_term(const meshes::ClothMesh &cloth,
                                     const std::vector<Eigen::Matrix3d> &stiffness,
                                     double viscosity);

/// Lumped masses: a third of each triangle's mass to its corners.
/// @param areal_density one per phase [kg/m^2]
/// @return (n) [kg]
/// @throws BadInput where a vertex would have no mass, or a density is not positive
Eigen::VectorXd lumped_masses(const meshes::ClothMesh &cloth,
                              const std::vector<double> &areal_density);
} // namespace homespun::shell
