// SPDX-License-Identifier: MIT
// A torus as a mesh of the plane, to be looked at and solved on.
#pragma once

#include "homogenization/cell/torus_mesh.h"
#include "meshes/plain/index.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace homespun::tests
{
/// The mesh cut open again: the triangles in their order, each where it lies in the plane. Its
/// precision is that of coordinates.
inline meshes::TriangleMesh unfolded(const homogenization::TorusMesh &mesh)
{
  using meshes::at;
  meshes::TriangleMesh plane;
  plane.triangles.resize(mesh.n_triangles(), 3);
  plane.material.resize(mesh.n_triangles());
  // A vertex of the torus lies at one point of the plane per lattice offset from where it was met
  // first.
  std::vector<Eigen::RowVector2d> points;
  std::vector<int> first_point(at(mesh.n_vertices), -1);
  std::map<std::array<long, 3>, int> point_of;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const homogenization::TorusTriangle &triangle = mesh.triangles[at(t)];
    const auto shape                              = triangle.shape(mesh.edges);
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::RowVector2d point = (triangle.corner + shape[at(k)]).transpose();
      const int vertex               = triangle.vertices[at(k)];
      int &first                     = first_point[at(vertex)];
      if (first < 0)
        first = static_cast<int>(points.size());
      else
      {
        const Eigen::RowVector2d f    = mesh.lattice.fractional(point - points[at(first)]);
        const std::array<long, 3> key = {vertex, std::lround(f(0)), std::lround(f(1))};
        const auto [place, is_new]    = point_of.emplace(key, static_cast<int>(points.size()));
        plane.triangles(t, k)         = place->second;
        if (is_new)
          points.push_back(points[at(first)] +
                           static_cast<double>(key[1]) * mesh.lattice.vectors.row(0) +
                           static_cast<double>(key[2]) * mesh.lattice.vectors.row(1));
        continue;
      }
      point_of[{vertex, 0, 0}] = first;
      plane.triangles(t, k)    = first;
      points.push_back(point);
    }
    plane.material(t) = triangle.material;
  }
  plane.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t v = 0; v < points.size(); ++v)
    plane.vertices.row(static_cast<Eigen::Index>(v)) = points[v];
  return plane;
}
} // namespace homespun::tests
