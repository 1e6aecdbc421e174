// SPDX-License-Identifier: MIT
// What a gradient of the macro strain does to a homogenized cloth, in its plane or in space: forces
// of the order of the cell (homogenization/edges/edge_layers.h).
#pragma once

#include "localization/coarse_frames.h"
#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <array>

namespace homespun::verification
{
/// A row of CoarseFrames::values().
template <int dim>
using FrameRow = Eigen::Matrix<double, 1, 3 + 2 * dim>;

template <int dim>
Eigen::Matrix<double, dim, 2> lift_of(const FrameRow<dim> &frame)
{
  return Eigen::Map<const Eigen::Matrix<double, dim, 2, Eigen::RowMajor>>(frame.data() + 3);
}

/// −integral M_abc d_b E_a E_c(v) on the vertices, the gradient that of the strains at them.
/// @param bulk M, entry (a,c) of bulk[b] [N]
/// @param of_vertices CoarseFrames::values() of the mesh, blended
/// @return (n,dim) [N]
template <int dim>
localization::Positions<dim>
bulk_forces(const meshes::TriangleMesh &mesh, const std::array<Eigen::Matrix3d, 2> &bulk,
            const Eigen::Matrix<double, Eigen::Dynamic, 3 + 2 * dim, Eigen::RowMajor> &of_vertices)
{
  localization::Positions<dim> forces = localization::Positions<dim>::Zero(mesh.n_vertices(), dim);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const meshes::TriangleGeometry of =
      meshes::triangle_geometry(meshes::sides_of_triangle<2>(mesh.triangles.row(t), mesh.vertices));
    const Eigen::Matrix<double, 2, 3> slopes = of.shape_gradients.transpose();
    Eigen::Matrix<double, 2, 3> gradient     = Eigen::Matrix<double, 2, 3>::Zero(); // d_b E_a
    FrameRow<dim> mean                       = FrameRow<dim>::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const FrameRow<dim> frame = of_vertices.row(mesh.triangles(t, k));
      gradient += slopes.col(k) * frame.template head<3>();
      mean += frame / 3.;
    }
    Eigen::RowVector3d stress = Eigen::RowVector3d::Zero(); // of E_c(v)
    for (int b = 0; b < 2; ++b)
      stress += gradient.row(b) * bulk[static_cast<std::size_t>(b)];
    Eigen::Matrix2d tensor;
    tensor << stress(0), stress(2), stress(2), stress(1);
    const Eigen::Matrix<double, dim, 2> nominal = of.area * lift_of<dim>(mean) * tensor;
    for (int k = 0; k < 3; ++k)
      forces.row(mesh.triangles(t, k)) -= (nominal * slopes.col(k)).transpose();
  }
  return forces;
}
} // namespace homespun::verification
