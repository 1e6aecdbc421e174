// SPDX-License-Identifier: MIT
#include "meshes/plain/triangle_sides.h"

#include <algorithm>

namespace homespun::meshes
{
TriangleSides::TriangleSides(const TriangleMesh &mesh)
    : of_triangle(mesh.n_triangles(), 3)
{
  // The sides whose lower corner is a vertex, as a list that is threaded through all sides: some
  // three at each.
  constexpr int none = -1;
  std::vector<int> first(static_cast<std::size_t>(mesh.n_vertices()), none);
  std::vector<int> next, upper_corner;
  const std::size_t about = static_cast<std::size_t>(mesh.n_triangles()) * 3 / 2;
  for (std::vector<int> *const of_side : {&next, &upper_corner, &n_triangles})
    of_side->reserve(about);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const auto [lower, upper] =
        std::minmax({mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)});
      int &begin = first[static_cast<std::size_t>(lower)];
      int side   = begin;
      while (side != none && upper_corner[static_cast<std::size_t>(side)] != upper)
        side = next[static_cast<std::size_t>(side)];
      if (side == none)
      {
        side = n();
        n_triangles.push_back(0);
        upper_corner.push_back(upper);
        next.push_back(begin);
        begin = side;
      }
      ++n_triangles[static_cast<std::size_t>(side)];
      of_triangle(t, k) = side;
    }
}
} // namespace homespun::meshes
