// SPDX-License-Identifier: MIT
// Small meshes that several tests need.
#pragma once

#include "meshes/plain/cross.h"
#include "meshes/plain/sheet.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace homespun::tests
{
/// A parallelogram of n1 x n2 x 2 triangles over the lattice; phase 0.
inline meshes::TriangleMesh parallelogram(const meshes::Lattice &lattice, const int n1,
                                          const int n2)
{
  Eigen::Matrix2d steps = lattice.vectors;
  steps.row(0) /= n1;
  steps.row(1) /= n2;
  return meshes::coarse_sheet({0., 0.}, steps, n1, n2);
}

/// Moves the vertices that lie strictly inside a parallelogram by a random part of the mesh width.
inline void shake(meshes::TriangleMesh &mesh, const meshes::Lattice &lattice, const double distance)
{
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> random(-distance, distance);
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = lattice.fractional(mesh.vertices.row(v));
    if (f.minCoeff() > 1e-9 && f.maxCoeff() < 1. - 1e-9)
      mesh.vertices.row(v) += Eigen::RowVector2d(random(generator), random(generator));
  }
}

inline meshes::Lattice square_lattice(const double side)
{
  return {side * Eigen::Matrix2d::Identity()};
}

inline meshes::Lattice skewed_lattice()
{
  meshes::Lattice lattice;
  lattice.vectors << 0.01, 0.001, 0.004, 0.012;
  return lattice;
}

/// Of all triangles [deg]; negative where one is turned over.
inline double smallest_angle(const meshes::TriangleMesh &mesh)
{
  double smallest = 180.;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::RowVector2d x = mesh.vertices.row(mesh.triangles(t, k)),
                               u = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3)) - x,
                               v = mesh.vertices.row(mesh.triangles(t, (k + 2) % 3)) - x;
      smallest = std::min(smallest, std::atan2(meshes::cross(u, v), u.dot(v)) * 180. / M_PI);
    }
  return smallest;
}
} // namespace homespun::tests
