// SPDX-License-Identifier: MIT
// The cross product of two vectors of the plane.
#pragma once

#include <Eigen/Core>

namespace homespun::meshes
{
/// a1 b2 − a2 b1: twice the area of the triangle between a and b, positive where b lies to the left
/// of a; rows or columns.
template <typename A, typename B>
typename A::Scalar cross(const Eigen::MatrixBase<A> &a, const Eigen::MatrixBase<B> &b)
{
  return a(0) * b(1) - a(1) * b(0);
}
} // namespace homespun::meshes
