// SPDX-License-Identifier: MIT
// The paper's nodal warping in place of the exact membrane, so that a report can show what it
// costs: a named variant, not recommended. Paper Eqs. 5-8 with the misprints repaired
// (shell/README.md lists them),
//   f_i = −R_i Σ_j k_ij (R_i^T x_j − X_j), j = i included, R_i = U diag(1, 1, det(U W^T)) W^T of
//   A_i = (Σ_j m_j (x_j − c)(X_j − C)^T + Σ_j A_j + w z Z^T) A_qq^-1,
//   A_j = (m_j/4) R_j diag(a², b², 0), w = ½ trace of the in-plane rest moment.
// Its forces have no energy, do not sum to zero, and have no component along a node's normal: a
// sheet clamped on four sides falls freely. As the matrix of a step serves R_i k_ij R_j^T, which is
// symmetric and positive semi-definite; the true Jacobian is neither.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/terms/term.h"

#include <memory>

namespace homespun::shell
{
/// @param stiffness one symmetric positive definite matrix (3,3) per phase [N/m]
/// @param masses (n) [kg]
/// @throws BadInput as membrane() does, and for a cloth with seams, whose vertices have no single
///   rest position
std::unique_ptr<Term> nodal_warping_term(const meshes::ClothMesh &cloth,
                                         const std::vector<Eigen::Matrix3d> &stiffness,
                                         const Eigen::VectorXd &masses);
} // namespace homespun::shell
