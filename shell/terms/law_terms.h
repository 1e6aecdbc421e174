// SPDX-License-Identifier: MIT
// The membrane of a moving cloth under a law of meshes/plain/law.h: the one place in which a law of
// coarse cloths is given its terms.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/plain/law.h"
#include "shell/membrane/six_node_membrane.h"
#include "shell/terms/term.h"

#include <memory>
#include <string>
#include <vector>

namespace homespun::shell
{
/// The names of the laws that a moving cloth may have.
std::vector<std::string> names_of_cloth_laws();

/// The elasticity of a membrane, and its viscosity where a law's own term has none.
/// @param six_nodes triangles of the membrane on the same vertices, of one phase; null: those of
///   the mesh
/// @param stiffness, viscosity, cubic as membrane_term() takes them
/// @throws BadInput as the terms do, and where a coarse cloth does not have the law
std::vector<std::unique_ptr<Term>> law_terms(meshes::Law law, const meshes::ClothMesh &cloth,
                                             const SixNodeMesh *six_nodes,
                                             const std::vector<Eigen::Matrix3d> &stiffness,
                                             double viscosity,
                                             const std::vector<meshes::CubicForm> &cubic = {});
} // namespace homespun::shell
