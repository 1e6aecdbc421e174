// SPDX-License-Identifier: MIT
#include "homogenization/fem/rigid_modes.h"

namespace homespun::homogenization
{
using namespace dealii;

std::vector<double> rigid_body_modes(const Discretization &discretization)
{
  const IndexSet &owned            = discretization.locally_owned;
  const std::size_t n              = owned.n_elements();
  const meshes::TriangleMesh &mesh = discretization.mesh;
  const Eigen::RowVector2d lowest  = mesh.vertices.colwise().minCoeff();
  const Eigen::RowVector2d highest = mesh.vertices.colwise().maxCoeff();
  const Eigen::RowVector2d centre  = 0.5 * (lowest + highest);
  const double size                = (highest - lowest).maxCoeff();

  std::vector<double> modes(3 * n, 0.);
  for (const Node &node : discretization.nodes())
  {
    if (!owned.is_element(node.first_dof))
      continue;
    const Eigen::RowVector2d arm = (node.point - centre) / size;
    const std::size_t first      = owned.index_within_set(node.first_dof);
    for (unsigned int c = 0; c < discretization.n_components; ++c)
      modes[c * n + first + c] = 1.;
    if (discretization.n_components == 2)
    {
      modes[2 * n + first]     = -arm(1);
      modes[2 * n + first + 1] = arm(0);
    }
  }
  return modes;
}
} // namespace homespun::homogenization
