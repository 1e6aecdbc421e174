// SPDX-License-Identifier: MIT
#include "homogenization/cell/laminate.h"

#include "homogenization/cell/material.h"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <map>

namespace homespun::homogenization
{
Eigen::Matrix3d laminate_stiffness(const std::vector<Eigen::Matrix3d> &layers,
                                   const std::vector<double> &fractions)
{
  Eigen::Matrix2d mean_inverse  = Eigen::Matrix2d::Zero();
  Eigen::RowVector2d mean_ratio = Eigen::RowVector2d::Zero();
  double mean_rest              = 0.;
  for (std::size_t k = 0; k < layers.size(); ++k)
  {
    const Eigen::Matrix2d inverse = layers[k].bottomRightCorner<2, 2>().inverse();
    const Eigen::RowVector2d c_ba = layers[k].block<1, 2>(0, 1);
    mean_inverse += fractions[k] * inverse;
    mean_ratio += fractions[k] * c_ba * inverse;
    mean_rest += fractions[k] * (layers[k](0, 0) - c_ba * inverse * c_ba.transpose());
  }
  Eigen::Matrix3d C;
  const Eigen::Matrix2d C_aa    = mean_inverse.inverse();
  const Eigen::RowVector2d C_ba = mean_ratio * C_aa;
  C.bottomRightCorner<2, 2>()   = C_aa;
  C.block<1, 2>(0, 1)           = C_ba;
  C.block<2, 1>(1, 0)           = C_ba.transpose();
  C(0, 0)                       = mean_rest + C_ba * mean_ratio.transpose();
  return C;
}

Eigen::Matrix3d laminate_stiffness(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                                   const std::vector<Eigen::Matrix3d> &stiffness_of_material)
{
  const meshes::ImageClasses classes = meshes::match_images(mesh.vertices, lattice);
  const auto stiffness_at            = [&](const int t) -> const Eigen::Matrix3d &
  { return stiffness_of_material[static_cast<std::size_t>(mesh.material(t))]; };
  // The direction of the layers is that of the longest edge with two stiffnesses beside it.
  using Edge = std::array<int, 4>; ///< the classes of its ends, and the lattice vector between them
  std::map<Edge, int> seen;
  Eigen::RowVector2d along(0., 0.);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      int a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      const auto of = [&](const int v)
      { return classes.representative[static_cast<std::size_t>(v)]; };
      Eigen::RowVector2i offset = classes.offset.row(b) - classes.offset.row(a);
      // From the lower class; between two images of one vertex, along the lattice.
      if (of(a) > of(b) || (of(a) == of(b) && (offset(0) < 0 || (offset(0) == 0 && offset(1) < 0))))
      {
        std::swap(a, b);
        offset = -offset;
      }
      const auto [other, is_new]    = seen.emplace(Edge{of(a), of(b), offset(0), offset(1)}, t);
      const Eigen::RowVector2d edge = mesh.vertices.row(b) - mesh.vertices.row(a);
      if (!is_new && stiffness_at(other->second) != stiffness_at(t) && edge.norm() > along.norm())
        along = edge;
    }
  const double angle         = along.norm() > 0. ? std::atan2(along(1), along(0)) : 0.;
  const Eigen::Matrix3d back = stiffness_rotation(-angle), turn = stiffness_rotation(angle);
  std::vector<Eigen::Matrix3d> layers;
  for (const Eigen::Matrix3d &c : stiffness_of_material)
    layers.emplace_back(back * c * back.transpose());
  std::vector<double> fractions(layers.size(), 0.);
  const Eigen::VectorXd areas = meshes::signed_areas(mesh);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    fractions[static_cast<std::size_t>(mesh.material(t))] += areas(t) / areas.sum();
  return turn * laminate_stiffness(layers, fractions) * turn.transpose();
}
} // namespace homespun::homogenization
