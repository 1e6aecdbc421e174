// SPDX-License-Identifier: MIT
#include "shell/terms/law_terms.h"

#include "meshes/plain/errors.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/six_node_term.h"
#include "shell/terms/yarn_term.h"

namespace homespun::shell
{
using meshes::ClothMesh;
using meshes::Law;

std::vector<std::string> names_of_cloth_laws()
{
  std::vector<std::string> names;
  for (const Law law : meshes::laws_with(&meshes::LawProperties::is_of_coarse_cloth))
    names.push_back(name_of(law));
  return names;
}

std::vector<std::unique_ptr<Term>> law_terms(const Law law, const ClothMesh &cloth,
                                             const SixNodeMesh *const six_nodes,
                                             const std::vector<Eigen::Matrix3d> &stiffness,
                                             const double viscosity,
                                             const std::vector<meshes::CubicForm> &cubic)
{
  std::vector<std::unique_ptr<Term>> terms;
  const auto add = [&](const auto &of_mesh)
  {
    terms.push_back(six_nodes != nullptr ? six_node_term(*six_nodes, stiffness.front(), of_mesh)
                                         : of_mesh(cloth));
  };
  switch (law)
  {
  case Law::biot:
    add([&](const ClothMesh &of) { return membrane_term(of, stiffness, viscosity, cubic); });
    return terms;
  case Law::yarn:
    add([&](const ClothMesh &of) { return yarn_term(of, stiffness); });
    break;
  default:
    throw meshes::BadInput("law `" + name_of(law) +
                           "`: a moving cloth does not have it; expected " +
                           meshes::one_of(names_of_cloth_laws()));
  }
  if (viscosity > 0.)
    add([&](const ClothMesh &of) { return viscosity_term(of, stiffness, viscosity); });
  return terms;
}
} // namespace homespun::shell
