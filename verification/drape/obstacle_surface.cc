// SPDX-License-Identifier: MIT
#include "verification/drape/obstacle_surface.h"

#include <Eigen/Geometry>

#include <cmath>

namespace homespun::verification
{
namespace
{
/// A grid of n1 x n2 quadrilaterals, each as two triangles.
/// @param point of the parameters in 0 ... 1
template <typename Point>
meshes::Surface grid(const int n1, const int n2, const Point &point)
{
  meshes::Surface surface;
  surface.positions.resize((n1 + 1) * (n2 + 1), 3);
  surface.triangles.resize(2 * n1 * n2, 3);
  for (int j = 0; j <= n2; ++j)
    for (int i = 0; i <= n1; ++i)
      surface.positions.row(j * (n1 + 1) + i) =
        point(static_cast<double>(i) / n1, static_cast<double>(j) / n2);
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i)
    {
      const int a = j * (n1 + 1) + i, c = a + n1 + 1, t = 2 * (j * n1 + i);
      surface.triangles.row(t) << a, a + 1, c + 1;
      surface.triangles.row(t + 1) << a, c + 1, c;
    }
  return surface;
}

meshes::Surface sphere(const Eigen::RowVector3d &centre, const double radius)
{
  return grid(48, 24,
              [&](const double a, const double b)
              {
                const double longitude = 2. * M_PI * a, latitude = M_PI * (b - 0.5);
                return (centre +
                        radius * Eigen::RowVector3d(std::cos(latitude) * std::cos(longitude),
                                                    std::cos(latitude) * std::sin(longitude),
                                                    std::sin(latitude)))
                  .eval();
              });
}

/// A square of a plane around the foot of `middle` on it.
meshes::Surface plane(const Eigen::RowVector3d &point, const Eigen::RowVector3d &normal,
                      const Eigen::RowVector3d &middle, const double half)
{
  const Eigen::RowVector3d n = normal.normalized(), first = n.unitOrthogonal(),
                           foot = middle - (middle - point).dot(n) * n, second = n.cross(first);
  return grid(1, 1,
              [&](const double a, const double b)
              { return (foot + half * ((2. * a - 1.) * first + (2. * b - 1.) * second)).eval(); });
}

void append(const meshes::Surface &part, meshes::Surface &all)
{
  const auto n = all.positions.rows(), m = all.triangles.rows();
  all.positions.conservativeResize(n + part.positions.rows(), 3);
  all.triangles.conservativeResize(m + part.triangles.rows(), 3);
  all.positions.bottomRows(part.positions.rows()) = part.positions;
  all.triangles.bottomRows(part.triangles.rows()) = part.triangles.array() + static_cast<int>(n);
}
} // namespace

meshes::Surface obstacle_surface(const Scene &scene, const Eigen::RowVector3d &middle,
                                 const double size)
{
  meshes::Surface all;
  all.positions.resize(0, 3);
  all.triangles.resize(0, 3);
  for (const SceneObstacle &obstacle : scene.obstacles)
  {
    const std::vector<double> &n = obstacle.numbers;
    const Eigen::RowVector3d at(n[0], n[1], n[2]);
    if (obstacle.kind == "sphere")
      append(sphere(at, n[3]), all);
    else if (obstacle.kind == "plane")
      append(plane(at, {n[3], n[4], n[5]}, middle, 1.5 * size), all);
    else
    {
      meshes::Surface body = meshes::read_surface(obstacle.file);
      body.positions.rowwise() += at;
      append(body, all);
    }
  }
  return all;
}
} // namespace homespun::verification
