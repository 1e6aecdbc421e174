// SPDX-License-Identifier: MIT
#include "meshes/plain/triangle_sides.h"
#include "tests/meshes/plain/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

using namespace homespun;
using meshes::TriangleSides;

// Euler: as many sides as vertices and triangles but one, in a mesh without holes.
TEST(exact_triangle_sides, two_triangles_have_a_side_in_common_where_they_have_its_corners)
{
  const meshes::TriangleMesh mesh = tests::parallelogram(tests::skewed_lattice(), 7, 5);
  const TriangleSides sides(mesh);
  EXPECT_EQ(sides.n(), mesh.n_vertices() + mesh.n_triangles() - 1);
  EXPECT_EQ(std::count(sides.n_triangles.begin(), sides.n_triangles.end(), 1), 2 * (7 + 5));
  std::map<std::array<int, 2>, int> side_of;
  std::vector<int> n_triangles(static_cast<std::size_t>(sides.n()), 0);
  int n_seen = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3),
                side             = sides.of_triangle(t, k);
      const auto [known, is_new] = side_of.insert({{std::min(a, b), std::max(a, b)}, side});
      EXPECT_EQ(known->second, side);
      if (is_new)
      {
        EXPECT_EQ(side, n_seen++); // as the triangles come to them
      }
      ++n_triangles.at(static_cast<std::size_t>(side));
    }
  EXPECT_EQ(n_triangles, sides.n_triangles);
}
