// SPDX-License-Identifier: MIT
// How far a point of a panel is from its seams.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace homespun::meshes
{
/// Distances to the seams of one panel [m], by buckets of the size of the reach; infinite beyond
/// it.
class SeamDistance
{
public:
  /// @param segments ends of what runs along the panel, in its frame [m]
  SeamDistance(std::vector<std::array<Eigen::RowVector2d, 2>> segments, const double reach)
      : segments(std::move(segments))
      , reach(reach)
  {
    for (std::size_t s = 0; s < this->segments.size(); ++s)
    {
      const auto &[from, to] = this->segments[s];
      const int n            = 1 + static_cast<int>((to - from).norm() / (0.5 * reach));
      for (int k = 0; k <= n; ++k)
      {
        const auto [i, j] = bucket(from + k / static_cast<double>(n) * (to - from));
        for (int dj = -2; dj <= 2; ++dj)
          for (int di = -2; di <= 2; ++di)
          {
            std::vector<int> &members = buckets[{i + di, j + dj}];
            if (members.empty() || members.back() != static_cast<int>(s))
              members.push_back(static_cast<int>(s));
          }
      }
    }
  }

  double operator()(const Eigen::RowVector2d &x) const
  {
    double nearest   = std::numeric_limits<double>::infinity();
    const auto found = buckets.find(bucket(x));
    if (found == buckets.end())
      return nearest;
    for (const int s : found->second)
    {
      const auto &[from, to] = segments[static_cast<std::size_t>(s)];
      const double part = std::clamp((x - from).dot(to - from) / (to - from).squaredNorm(), 0., 1.);
      nearest           = std::min(nearest, (x - from - part * (to - from)).norm());
    }
    return nearest <= reach ? nearest : std::numeric_limits<double>::infinity();
  }

private:
  std::array<int, 2> bucket(const Eigen::RowVector2d &x) const
  {
    return {static_cast<int>(std::floor(x(0) / reach)), static_cast<int>(std::floor(x(1) / reach))};
  }

  std::vector<std::array<Eigen::RowVector2d, 2>> segments;
  double reach;
  std::map<std::array<int, 2>, std::vector<int>> buckets;
};
} // namespace homespun::meshes
