// SPDX-License-Identifier: MIT
#include "meshes/plain/refine.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace homespun::meshes
{
namespace
{
TriangleMesh refined_once(const TriangleMesh &mesh)
{
  const int n = mesh.n_vertices(), m = mesh.n_triangles();
  TriangleMesh fine;
  // At most three new vertices per triangle; cut to size afterwards.
  fine.vertices.resize(n + 3 * m, 2);
  fine.vertices.topRows(n) = mesh.vertices;
  fine.triangles.resize(4 * m, 3);
  fine.material.resize(4 * m);

  std::unordered_map<std::uint64_t, int> midpoint_of;
  midpoint_of.reserve(2 * static_cast<std::size_t>(m));
  int n_fine          = n;
  const auto midpoint = [&](const int a, const int b)
  {
    const std::uint64_t key =
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(a, b))) << 32) |
      static_cast<std::uint32_t>(std::max(a, b));
    const auto [place, is_new] = midpoint_of.emplace(key, n_fine);
    if (is_new)
      fine.vertices.row(n_fine++) = 0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b));
    return place->second;
  };
  for (int t = 0; t < m; ++t)
  {
    const int a = mesh.triangles(t, 0), b = mesh.triangles(t, 1), c = mesh.triangles(t, 2);
    const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    fine.triangles.row(4 * t) << a, ab, ca;
    fine.triangles.row(4 * t + 1) << ab, b, bc;
    fine.triangles.row(4 * t + 2) << ca, bc, c;
    fine.triangles.row(4 * t + 3) << ab, bc, ca;
    fine.material.segment<4>(4 * t).setConstant(mesh.material(t));
  }
  fine.vertices.conservativeResize(n_fine, 2);
  return fine;
}
} // namespace

TriangleMesh refined(const TriangleMesh &mesh, const int times)
{
  TriangleMesh fine = mesh;
  for (int k = 0; k < times; ++k)
    fine = refined_once(fine);
  return fine;
}
} // namespace homespun::meshes
