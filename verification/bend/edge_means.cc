// SPDX-License-Identifier: MIT
#include "verification/bend/edge_means.h"

#include "meshes/plain/cell_edges.h"

#include <algorithm>

namespace homespun::verification
{
EdgeMeans::EdgeMeans(const meshes::Sheet &sheet, const int edge)
{
  const Eigen::Vector2d side =
    sheet.lattice.vectors.row(1 - meshes::axis_of_side(edge)).transpose();
  along     = side.normalized();
  half_cell = 0.5 * side.norm();
}

void EdgeMeans::add(const std::array<Eigen::Vector2d, 2> &ends, const Eigen::Vector3d &curvature)
{
  const auto [begin, end] = std::minmax({along.dot(ends[0]), along.dot(ends[1])});
  sides.push_back({begin, end, curvature});
}

Eigen::Vector3d EdgeMeans::at(const Eigen::Vector2d &point) const
{
  const double place  = along.dot(point);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double length       = 0.;
  for (const Side &side : sides)
    if (const double within =
          std::min(side.end, place + half_cell) - std::max(side.begin, place - half_cell);
        within > 0.)
    {
      sum += within * side.curvature;
      length += within;
    }
  return sum / length;
}
} // namespace homespun::verification
