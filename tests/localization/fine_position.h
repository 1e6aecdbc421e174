// SPDX-License-Identifier: MIT
// The definition of an up-sampled position, one point at a time: the formula on top of
// localization/coarse_frames.h. The Upsampler computes the same for all points.
#pragma once

#include "localization/coarse_frames.h"

namespace homespun::tests
{
/// Frame at a point of a coarse triangle, interpolated from CoarseFrames::values().
/// @param weights barycentric coordinates of the point in the triangle
template <int dim>
localization::Frame<dim> frame_at(const localization::CoarseFrames<dim> &frames, const int triangle,
                                  const Eigen::Vector3d &weights,
                                  const localization::Positions<dim> &current)
{
  const auto &values = frames.values(current);
  if (values.rows() == frames.rest().n_triangles()) // piecewise; no mesh has as many vertices
    return frames.of_triangle(triangle, current);
  Eigen::Matrix<double, 1, 3 + 2 *dim> row = Eigen::Matrix<double, 1, 3 + 2 * dim>::Zero();
  for (int k = 0; k < 3; ++k)
    row += weights(k) * values.row(frames.rest().triangles(triangle, k));
  localization::Frame<dim> frame;
  frame.strain = row.template head<3>().transpose();
  for (int i = 0; i < dim; ++i)
    frame.lift.row(i) << row(3 + 2 * i), row(4 + 2 * i);
  return frame;
}

/// @param weights barycentric coordinates of the point's rest position in the coarse triangle
/// @param chi its row of the characteristic displacements, column 2 a + c [m]
/// @param quadratic its row of the quadratic modes, which w is extended by [m]
/// @return (dim) [m]
template <int dim>
Eigen::Matrix<double, dim, 1>
fine_position(const localization::CoarseFrames<dim> &frames, const int triangle,
              const Eigen::Vector3d &weights, const Eigen::Matrix<double, 1, 6> &chi,
              const localization::Positions<dim> &current,
              const Eigen::Matrix<double, 1, 12> &quadratic = Eigen::Matrix<double, 1, 12>::Zero())
{
  const localization::Frame<dim> frame = frame_at<dim>(frames, triangle, weights, current);
  Eigen::Vector2d w                    = Eigen::Vector2d::Zero();
  for (int a = 0; a < 3; ++a)
    w -= frame.strain(a) * chi.segment<2>(2 * a).transpose();
  const Eigen::Matrix<double, 6, 1> factors = meshes::quadratic_factors(frame.strain);
  for (int k = 0; k < 6; ++k)
    w -= factors(k) * quadratic.segment<2>(2 * k).transpose();
  Eigen::Matrix<double, dim, 1> position = frame.lift * w;
  for (int k = 0; k < 3; ++k)
    position += weights(k) * current.row(frames.rest().triangles(triangle, k)).transpose();
  return position;
}
} // namespace homespun::tests
