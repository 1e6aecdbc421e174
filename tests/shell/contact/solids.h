// SPDX-License-Identifier: MIT
// Closed surfaces that tests of obstacles and pressure share.
#pragma once

#include "meshes/cloth/cloth_mesh.h"

#include <cmath>

namespace homespun::tests
{
struct Solid
{
  meshes::SpacePoints vertices;
  meshes::Triangles triangles; ///< counter-clockwise seen from outside
};

/// A box around the origin, two triangles per face.
inline Solid box(const Eigen::Vector3d &half)
{
  Solid solid;
  solid.vertices.resize(8, 3);
  for (int v = 0; v < 8; ++v)
    for (int i = 0; i < 3; ++i)
      solid.vertices(v, i) = (v >> i & 1 ? 1. : -1.) * half(i);
  solid.triangles.resize(12, 3);
  solid.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4,
    6, 0, 6, 2, 1, 3, 7, 1, 7, 5;
  return solid;
}

/// A ring around the third axis of n1 x n2 x 2 triangles.
inline Solid torus(const double ring, const double tube, const int n1, const int n2)
{
  Solid solid;
  solid.vertices.resize(n1 * n2, 3);
  solid.triangles.resize(2 * n1 * n2, 3);
  for (int i = 0; i < n1; ++i)
    for (int j = 0; j < n2; ++j)
    {
      const double a = 2. * M_PI * i / n1, b = 2. * M_PI * j / n2, r = ring + tube * std::cos(b);
      solid.vertices.row(i * n2 + j) << r * std::cos(a), r * std::sin(a), tube * std::sin(b);
      const int i1 = (i + 1) % n1, j1 = (j + 1) % n2, v00 = i * n2 + j, v10 = i1 * n2 + j,
                v11 = i1 * n2 + j1, v01 = i * n2 + j1;
      solid.triangles.row(2 * v00) << v00, v10, v11;
      solid.triangles.row(2 * v00 + 1) << v00, v11, v01;
    }
  return solid;
}
} // namespace homespun::tests
