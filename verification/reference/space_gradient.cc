// SPDX-License-Identifier: MIT
#include "verification/reference/space_gradient.h"

#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/LU>

namespace homespun::verification
{
meshes::SpacePoints space_gradient(const meshes::TriangleMesh &rest,
                                   const std::vector<Eigen::Matrix3d> &stiffness_of_phase,
                                   const Law law, const meshes::SpacePoints &positions)
{
  meshes::SpacePoints gradient = meshes::SpacePoints::Zero(positions.rows(), 3);
  for (int t = 0; t < rest.n_triangles(); ++t)
  {
    const Eigen::RowVector3i corners      = rest.triangles.row(t);
    const Eigen::Matrix2d at_rest         = meshes::sides_of_triangle<2>(corners, rest.vertices);
    const Eigen::Matrix<double, 3, 2> now = meshes::sides_of_triangle<3>(corners, positions);
    const Eigen::Matrix2d inverse = at_rest.inverse(); // rows: the gradients of two of the shapes
    const SpaceGradient stress =
      space_response(law, stiffness_of_phase[static_cast<std::size_t>(rest.material(t))],
                     now * inverse, Tangent::none)
        .stress;
    const Eigen::Matrix<double, 2, 3> forces =
      0.5 * at_rest.determinant() * inverse * stress.transpose();
    for (int k = 0; k < 2; ++k)
    {
      gradient.row(corners(k + 1)) += forces.row(k);
      gradient.row(corners(0)) -= forces.row(k);
    }
  }
  return gradient;
}
} // namespace homespun::verification
