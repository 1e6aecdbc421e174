// SPDX-License-Identifier: MIT
// Strains of a cell whose characteristic displacements are linear in each triangle.
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/triangle_kinematics.h"

namespace homespun::homogenization
{
/// e − eps(chi) in a triangle under the unit macro strains e = 11, 22, 12, a column each, of
/// components 11, 22, 12 with engineering shear [-].
inline Eigen::Matrix3d strains_in(const meshes::TriangleMesh &mesh, const meshes::Chi &chi,
                                  const int triangle)
{
  const Eigen::RowVector3i corners = mesh.triangles.row(triangle);
  Eigen::Matrix<double, 3, 6> at_corners;
  for (int k = 0; k < 3; ++k)
    at_corners.row(k) = chi.row(corners(k));
  const Eigen::Matrix<double, 2, 6> gradient = // row d: derivative by x_d
    meshes::triangle_geometry(meshes::sides_of_triangle<2>(corners, mesh.vertices))
      .shape_gradients.transpose() *
    at_corners;
  Eigen::Matrix3d strain = Eigen::Matrix3d::Identity();
  for (int load = 0; load < 3; ++load)
    strain.col(load) -= Eigen::Vector3d(gradient(0, 2 * load), gradient(1, 2 * load + 1),
                                        gradient(1, 2 * load) + gradient(0, 2 * load + 1));
  return strain;
}
} // namespace homespun::homogenization
