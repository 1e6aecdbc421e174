// SPDX-License-Identifier: MIT
#include "meshes/cloth/irregular_sheet.h"

#include "meshes/plain/sheet.h"

#include <random>

namespace homespun::meshes
{
SpacePoints random_vectors(const Eigen::Index n, const unsigned int seed)
{
  // Without std::uniform_real_distribution, whose numbers differ between libraries.
  std::mt19937 generator(seed);
  SpacePoints vectors(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c)
      vectors(i, c) = static_cast<double>(generator()) / 2147483647.5 - 1.;
  return vectors;
}

TriangleMesh irregular_sheet(const int n, const double side)
{
  TriangleMesh mesh       = coarse_sheet({0., 0.}, side / n * Eigen::Matrix2d::Identity(), n, n);
  const SpacePoints shift = 0.25 * side / n * random_vectors(mesh.n_vertices(), 7);
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i)
      mesh.vertices.row(j * (n + 1) + i) += shift.row(j * (n + 1) + i).head<2>();
  return mesh;
}
} // namespace homespun::meshes
