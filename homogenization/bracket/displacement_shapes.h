// SPDX-License-Identifier: MIT
// Displacements of a straight triangle with three (P1) or six nodes (P2): its corners, then the
// middles of its sides 01, 12, 20.
#pragma once

#include <Eigen/Core>

namespace homespun::homogenization
{
/// The values of the shape functions at a point.
template <int n_shapes>
Eigen::Matrix<double, n_shapes, 1> shape_values(const Eigen::Vector3d &barycentric)
{
  if constexpr (n_shapes == 3)
    return barycentric;
  Eigen::Matrix<double, n_shapes, 1> values;
  for (int i = 0; i < n_shapes; ++i)
    values(i) = i < 3 ? barycentric(i) * (2. * barycentric(i) - 1.)
                      : 4. * barycentric(i - 3) * barycentric((i - 2) % 3);
  return values;
}

/// The strain-displacement matrix B at a point, rows 11, 22, 12 (3,2n) [1/m].
/// @param gradients of the barycentric coordinates [1/m]
template <int n_shapes>
Eigen::Matrix<double, 3, 2 * n_shapes>
strain_displacement(const Eigen::Matrix<double, 3, 2> &gradients,
                    const Eigen::Vector3d &barycentric)
{
  Eigen::Matrix<double, 3, 2 * n_shapes> B;
  for (int i = 0; i < n_shapes; ++i)
  {
    Eigen::RowVector2d g = gradients.row(i % 3);
    if (n_shapes == 6 && i < 3)
      g *= 4. * barycentric(i) - 1.;
    else if (n_shapes == 6)
      g = 4. * (barycentric(i - 3) * gradients.row((i - 2) % 3) +
                barycentric((i - 2) % 3) * gradients.row(i - 3));
    B.col(2 * i) << g(0), 0., g(1);
    B.col(2 * i + 1) << 0., g(1), g(0);
  }
  return B;
}
} // namespace homespun::homogenization
