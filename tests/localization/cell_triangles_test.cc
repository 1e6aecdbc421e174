// SPDX-License-Identifier: MIT
// The coarse triangles of a cell, its sides whole or halved.
#include "localization/cell_triangles.h"
#include "tests/localization/localization_cases.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::localization;

// A vertex is where its weights put it in the coarse mesh, and in the triangle, in every cell.
TEST(exact_cell_triangles, vertices_of_a_cell_lie_in_its_triangles)
{
  const tests::Cloth cloth   = tests::skewed_cloth();
  const meshes::Sheet &sheet = cloth.sheet;
  for (const int quads : {1, 2})
  {
    const meshes::TriangleMesh coarse = meshes::coarse_sheet(
      sheet.origin, sheet.lattice.vectors / quads, quads * sheet.n1, quads * sheet.n2);
    ASSERT_EQ(quads_per_cell(sheet, coarse), quads);
    const std::vector<CellTriangle> triangles = triangles_of_cell(sheet, quads);
    ASSERT_EQ(triangles.size(), static_cast<std::size_t>(2 * quads * quads));
    int next = 0;
    for (const CellTriangle &triangle : triangles)
    {
      EXPECT_EQ(triangle.begin, next);
      next = triangle.end;
      for (int v = triangle.begin; v < triangle.end; ++v)
      {
        const Eigen::Vector3d weights = weights_in(triangle.in_cell, quads, sheet, v);
        EXPECT_GE(weights.minCoeff(), -1e-9);
        for (int j = 0; j < sheet.n2; ++j)
          for (int i = 0; i < sheet.n1; ++i)
          {
            const auto corners =
              coarse.triangles.row(coarse_triangle(triangle.in_cell, quads, sheet.n1, i, j));
            Eigen::RowVector2d point = Eigen::RowVector2d::Zero();
            for (int k = 0; k < 3; ++k)
              point += weights(k) * coarse.vertices.row(corners(k));
            const int image = (j * sheet.n1 + i) * sheet.n_per_cell + v;
            EXPECT_LT((point - sheet.mesh.vertices.row(image)).norm(), 1e-15);
          }
      }
    }
    EXPECT_EQ(next, sheet.n_per_cell);
  }
}
