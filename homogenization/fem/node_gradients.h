// SPDX-License-Identifier: MIT
// Gradients of shapes, cell after cell, for loops that go over all cells many times.
#pragma once

#include "homogenization/fem/discretization.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// Gradients of the shapes of one component, which all share: shape k is that of node k. Those of
/// deal.II on the reference triangle, mapped by the straight sides of a triangle of the mesh:
///   grad N = J^-T grad_ref N,    J = (x1 - x0, x2 - x0).
/// FEValues gives the same to round-off, for any map.
class NodeGradients
{
public:
  /// @param discretization whose mesh is read as long as this lives
  NodeGradients(const Discretization &discretization, const dealii::Quadrature<2> &quadrature);

  /// Takes up a triangle of the mesh.
  void reinit(int triangle);

  int n_points() const
  {
    return static_cast<int>(weights.size());
  }

  /// Of the triangle [m^2].
  double area() const
  {
    return area_of_triangle;
  }

  /// What point q stands for [m^2].
  double weight(const int q) const
  {
    return weights[static_cast<std::size_t>(q)] * 2. * area_of_triangle;
  }

  /// (shape, axis) at point q [1/m]
  template <int n_shapes>
  Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor> at(const int q) const
  {
    using Gradients = Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor>;
    const Eigen::Map<const Gradients> of_reference(on_reference.data() + q * 2 * n_shapes);
    return of_reference.lazyProduct(inverse_jacobian);
  }

private:
  const meshes::TriangleMesh &mesh;
  std::vector<double> weights;      ///< on the reference triangle, whose area is a half
  std::vector<double> on_reference; ///< gradients, axis by axis, shape by shape, point by point
  Eigen::Matrix2d inverse_jacobian;
  double area_of_triangle = 0.;
};
} // namespace homespun::homogenization
