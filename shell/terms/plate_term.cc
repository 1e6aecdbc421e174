// SPDX-License-Identifier: MIT
#include "shell/terms/plate_term.h"

namespace homespun::shell
{
std::unique_ptr<Term> plate_term(const meshes::ClothMesh &mesh,
                                 const std::vector<PlateStiffness> &stiffness,
                                 const PlateModel model)
{
  const auto is_exact = [&]
  { return mesh.triangles == mesh.rest.triangles && is_cut_along_one_diagonal(mesh, stiffness); };
  if (model == PlateModel::hinges || (model == PlateModel::by_mesh && is_exact()))
    return bending_term(mesh, stiffness);
  return edge_angles_term(mesh, stiffness);
}
} // namespace homespun::shell
