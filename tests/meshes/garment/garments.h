// SPDX-License-Identifier: MIT
// Garments that several tests need.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <vector>

namespace homespun::tests
{
inline Eigen::Matrix2d turn(const double angle)
{
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

/// Two panels of 6 x 5 and 4 x 5 squares of about 1 cm, sewn along a curved side. Flat, they fit
/// together at the points `flat` of the vertices in space; at rest the second is turned and lies
/// elsewhere.
struct TwoPanels
{
  static constexpr double angle = 0.7; ///< of the second panel's rest frame [rad]

  meshes::ClothMesh cloth;
  meshes::Points flat; ///< (n,2) of the vertices in space [m]

  /// Rest coordinates of a flat point.
  static Eigen::RowVector2d rest_of(const int panel, const Eigen::RowVector2d &point)
  {
    if (panel == 0)
      return point;
    return (point - Eigen::RowVector2d(0.1, 0.)) * turn(angle).transpose() +
           Eigen::RowVector2d(0.3, -0.2);
  }

  /// The flat point of rest coordinates.
  static Eigen::RowVector2d flat_of(const int panel, const Eigen::RowVector2d &rest)
  {
    if (panel == 0)
      return rest;
    const double x = rest(0) - 0.3, y = rest(1) + 0.2, c = std::cos(angle), s = std::sin(angle);
    return {c * x + s * y + 0.1, c * y - s * x};
  }

  TwoPanels()
  {
    constexpr int columns = 10, rows = 5, seam = 6;
    const auto index = [](const int i, const int j) { return j * (columns + 1) + i; };
    flat.resize((columns + 1) * (rows + 1), 2);
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= columns; ++i)
      {
        const double bulge = 0.004 * std::sin(0.8 * j) * std::min(i, columns - i) / 5.;
        flat.row(index(i, j)) << 0.0103 * i + bulge, 0.0097 * j + 0.0002 * i * (j % 2);
      }
    cloth.positions.setZero(flat.rows(), 3);
    cloth.positions.leftCols<2>() = flat;
    cloth.triangles.resize(2 * columns * rows, 3);
    cloth.rest.triangles.resize(2 * columns * rows, 3);
    cloth.rest.material.setZero(2 * columns * rows);
    std::map<std::array<int, 2>, int> rest_vertex; // of panel and vertex in space
    int t = 0;
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        for (const bool below : {true, false})
        {
          if (below)
            cloth.triangles.row(t) << index(i, j), index(i + 1, j), index(i + 1, j + 1);
          else
            cloth.triangles.row(t) << index(i, j), index(i + 1, j + 1), index(i, j + 1);
          for (int k = 0; k < 3; ++k)
            cloth.rest.triangles(t, k) =
              rest_vertex
                .emplace(std::array<int, 2>{i < seam ? 0 : 1, cloth.triangles(t, k)},
                         static_cast<int>(rest_vertex.size()))
                .first->second;
          ++t;
        }
    cloth.rest.vertices.resize(static_cast<Eigen::Index>(rest_vertex.size()), 2);
    for (const auto &[key, v] : rest_vertex)
      cloth.rest.vertices.row(v) = rest_of(key[0], flat.row(key[1]));
  }
};

/// A flat panel between two circles, cut open nowhere: a curved outline and a hole.
inline meshes::ClothMesh ring(const double inner, const double outer, const int n,
                              const Eigen::RowVector2d &centre)
{
  meshes::TriangleMesh mesh;
  constexpr int layers = 3;
  mesh.vertices.resize(n * (layers + 1), 2);
  mesh.triangles.resize(2 * n * layers, 3);
  mesh.material.setZero(2 * n * layers);
  for (int j = 0; j <= layers; ++j)
    for (int i = 0; i < n; ++i)
    {
      const double angle = 2. * M_PI * i / n, radius = inner + (outer - inner) * j / layers;
      mesh.vertices.row(j * n + i) =
        centre + radius * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
    }
  int t = 0;
  for (int j = 0; j < layers; ++j)
    for (int i = 0; i < n; ++i)
    {
      const int a = j * n + i, b = (j + 1) * n + i, c = (j + 1) * n + (i + 1) % n,
                d = j * n + (i + 1) % n;
      mesh.triangles.row(t++) << a, b, c;
      mesh.triangles.row(t++) << a, c, d;
    }
  return meshes::placed_sheet(mesh, Eigen::Matrix<double, 3, 2>::Identity(), {0., 0., 0.});
}

/// V − E + F of triangles: 2 for a sphere, 1 for a disc, 0 for a ring; and how many edges are open.
struct Topology
{
  int euler = 0, n_open = 0, n_branching = 0;
};
inline Topology topology_of(const meshes::Triangles &triangles)
{
  std::map<std::array<int, 2>, int> edges;
  std::map<int, int> vertices;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      ++edges[{std::min(a, b), std::max(a, b)}];
      ++vertices[a];
    }
  Topology topology;
  topology.euler = static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) +
                   static_cast<int>(triangles.rows());
  for (const auto &[edge, n] : edges)
  {
    topology.n_open += n == 1 ? 1 : 0;
    topology.n_branching += n > 2 ? 1 : 0;
  }
  return topology;
}
} // namespace homespun::tests
