// SPDX-License-Identifier: MIT
#include "meshes/plain/point_location.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace homespun::meshes
{
namespace
{
constexpr double tolerance = 1e-6; // of barycentric coordinates

std::vector<int> all_triangles(const TriangleMesh &mesh)
{
  std::vector<int> triangles(static_cast<std::size_t>(mesh.n_triangles()));
  std::iota(triangles.begin(), triangles.end(), 0);
  return triangles;
}
} // namespace

PointLocation::PointLocation(const TriangleMesh &mesh)
    : PointLocation(mesh, all_triangles(mesh))
{
}

PointLocation::PointLocation(const TriangleMesh &mesh, const std::vector<int> &some_triangles)
    : mesh(mesh)
{
  const auto m = static_cast<double>(some_triangles.size());
  low.setConstant(std::numeric_limits<double>::infinity());
  Eigen::RowVector2d high = -low;
  for (const int t : some_triangles)
    for (int k = 0; k < 3; ++k)
    {
      low  = low.cwiseMin(mesh.vertices.row(mesh.triangles(t, k)));
      high = high.cwiseMax(mesh.vertices.row(mesh.triangles(t, k)));
    }
  const Eigen::RowVector2d size = high - low;
  const double side             = std::sqrt(size(0) * size(1) / m);
  for (int axis = 0; axis < 2; ++axis)
  {
    n_buckets[axis] = std::clamp(static_cast<int>(size(axis) / side), 1, 4096);
    width(axis)     = size(axis) / n_buckets[axis];
  }
  // Twice over the triangles: count, then fill.
  first.assign(static_cast<std::size_t>(n_buckets[0] * n_buckets[1]) + 1, 0);
  const auto visit = [&](const auto &&action)
  {
    for (const int t : some_triangles)
    {
      Eigen::RowVector2d from = mesh.vertices.row(mesh.triangles(t, 0)), to = from;
      for (int k = 1; k < 3; ++k)
      {
        from = from.cwiseMin(mesh.vertices.row(mesh.triangles(t, k)));
        to   = to.cwiseMax(mesh.vertices.row(mesh.triangles(t, k)));
      }
      const Eigen::RowVector2d margin = 4. * tolerance * (to - from);
      for (int j = bucket(from(1) - margin(1), 1); j <= bucket(to(1) + margin(1), 1); ++j)
        for (int i = bucket(from(0) - margin(0), 0); i <= bucket(to(0) + margin(0), 0); ++i)
          action(static_cast<std::size_t>(j * n_buckets[0] + i), t);
    }
  };
  visit([&](const std::size_t b, int) { ++first[b + 1]; });
  for (std::size_t b = 1; b < first.size(); ++b)
    first[b] += first[b - 1];
  members.resize(static_cast<std::size_t>(first.back()));
  std::vector<int> next(first.begin(), first.end() - 1);
  visit([&](const std::size_t b, const int t)
        { members[static_cast<std::size_t>(next[b]++)] = t; });
}

int PointLocation::bucket(const double coordinate, const int axis) const
{
  const double place = std::floor((coordinate - low(axis)) / width(axis));
  return static_cast<int>(std::clamp(place, 0., n_buckets[axis] - 1.));
}

Eigen::Vector3d PointLocation::weights(const int triangle, const Eigen::RowVector2d &point) const
{
  const Eigen::RowVector2d x0 = mesh.vertices.row(mesh.triangles(triangle, 0)),
                           e1 = mesh.vertices.row(mesh.triangles(triangle, 1)) - x0,
                           e2 = mesh.vertices.row(mesh.triangles(triangle, 2)) - x0, d = point - x0;
  const double doubled = e1(0) * e2(1) - e1(1) * e2(0);
  const double b1      = (d(0) * e2(1) - d(1) * e2(0)) / doubled,
               b2      = (e1(0) * d(1) - e1(1) * d(0)) / doubled;
  return {1. - b1 - b2, b1, b2};
}

Location PointLocation::locate(const Eigen::RowVector2d &point,
                               const Eigen::RowVector2d &towards) const
{
  Location best;
  double best_score = 0.;
  if (!point.allFinite())
    return best;
  const auto b = static_cast<std::size_t>(bucket(point(1), 1) * n_buckets[0] + bucket(point(0), 0));
  for (int slot = first[b]; slot < first[b + 1]; ++slot)
  {
    const int t                     = members[static_cast<std::size_t>(slot)];
    const Eigen::Vector3d candidate = weights(t, point);
    if (candidate.minCoeff() < -tolerance)
      continue;
    const double score = weights(t, point + towards).minCoeff();
    if (best.triangle < 0 || score > best_score)
    {
      best       = {t, candidate};
      best_score = score;
    }
  }
  return best;
}
} // namespace homespun::meshes
