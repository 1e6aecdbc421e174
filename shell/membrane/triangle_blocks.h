// SPDX-License-Identifier: MIT
// The second derivatives of a triangle by blocks of its corners, whatever its law.
#pragma once

#include <Eigen/Core>

#include <array>

namespace homespun::shell
{
/// Blocks of the corners (0,0) (0,1) (0,2) (1,1) (1,2) (2,2) [N/m].
template <int dim>
using TriangleBlocks = std::array<Eigen::Matrix<double, dim, dim>, 6>;

/// The blocks of corner 0 from the others: minus their sums, so that a translation costs nothing,
/// to round-off.
template <int dim>
void find_blocks_of_first_corner(TriangleBlocks<dim> &blocks)
{
  blocks[1] = -(blocks[3] + blocks[4].transpose());
  blocks[2] = -(blocks[4] + blocks[5]);
  blocks[0] = -(blocks[1] + blocks[2]).transpose();
}

/// The whole matrix; component i of corner k is unknown k dim + i.
/// @return (3 dim, 3 dim) [N/m]
template <int dim>
Eigen::Matrix<double, 3 * dim, 3 * dim> hessian_of_blocks(const TriangleBlocks<dim> &blocks)
{
  Eigen::Matrix<double, 3 * dim, 3 * dim> hessian;
  hessian << blocks[0], blocks[1], blocks[2],    //
    blocks[1].transpose(), blocks[3], blocks[4], //
    blocks[2].transpose(), blocks[4].transpose(), blocks[5];
  return hessian;
}
} // namespace homespun::shell
