// SPDX-License-Identifier: MIT
// The membrane of a moving cloth of yarns: the energy of yarn_energy.h in the place of the
// corotational one of membrane_term.h, E = Σ_triangles A W. Phases that are alike in all directions
// stay corotational. Its viscosity, where there is one, is viscosity_term() beside it. A conserving
// step takes it (yarn_discrete_gradient.h).
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/membrane/membrane.h"
#include "shell/terms/term.h"

#include <memory>

namespace homespun::shell
{
/// @param stiffness one symmetric positive definite matrix (3,3) per phase, cloth.rest.material,
///   whose axes are those of its yarns [N/m]
/// @throws BadInput as membrane() does, and where no stiffness has axes
std::unique_ptr<Term> yarn_term(const meshes::ClothMesh &cloth,
                                const std::vector<Eigen::Matrix3d> &stiffness);
} // namespace homespun::shell
