// SPDX-License-Identifier: MIT
// Nodes and functions of the two triangles of a cell, their sides halved.
#include "localization/cell_nodes.h"
#include "tests/localization/localization_cases.h"

#include <gtest/gtest.h>

#include <array>

using namespace homespun;
using namespace homespun::localization;

TEST(exact_cell_nodes, nodes_are_the_corners_of_a_triangle_and_the_middles_of_its_sides)
{
  const tests::Cloth cloth   = tests::skewed_cloth();
  const meshes::Sheet &sheet = cloth.sheet;
  for (const int quads : {1, 2})
  {
    const meshes::TriangleMesh coarse = meshes::coarse_sheet(
      sheet.origin, sheet.lattice.vectors / quads, quads * sheet.n1, quads * sheet.n2);
    ASSERT_EQ(quads_per_cell(sheet, coarse), quads);
    for (int j = 0; j < sheet.n2; ++j)
      for (int i = 0; i < sheet.n1; ++i)
        for (const Half half : {Half::below, Half::above})
        {
          const std::array<int, 6> nodes = nodes_of_triangle(quads, sheet.n1, i, j, half);
          std::array<Eigen::RowVector2d, 3> corners;
          for (std::size_t k = 0; k < 3; ++k)
          {
            corners[k] = cloth.coarse.vertices.row(cloth.coarse.triangles(
              2 * (j * sheet.n1 + i) + (half == Half::above), static_cast<int>(k)));
            EXPECT_LT((coarse.vertices.row(nodes[k]) - corners[k]).norm(), 1e-15);
          }
          for (std::size_t side = 0; side < 3 && quads == 2; ++side)
          {
            const std::array<std::size_t, 2> ends =
              std::array<std::array<std::size_t, 2>, 3>{{{0, 1}, {1, 2}, {0, 2}}}[side];
            EXPECT_LT(
              (coarse.vertices.row(nodes[3 + side]) - 0.5 * (corners[ends[0]] + corners[ends[1]]))
                .norm(),
              1e-15);
          }
        }
  }
}

TEST(exact_cell_nodes, hats_are_one_at_their_own_node_and_linear_in_each_of_the_four_parts)
{
  // A part's corners: corners 0, 1, 2 of the triangle, then the middles of 01, 12, 02.
  Eigen::Matrix<double, 6, 3> nodes;
  nodes << 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.5, 0.5, 0., 0., 0.5, 0.5, 0.5, 0., 0.5;
  for (const std::array<int, 3> &part :
       {std::array<int, 3>{0, 3, 5}, {1, 4, 3}, {2, 5, 4}, {3, 4, 5}})
    for (const Eigen::RowVector3d &b :
         {Eigen::RowVector3d(1., 0., 0.), Eigen::RowVector3d(0., 1., 0.),
          Eigen::RowVector3d(0.5, 0., 0.5), Eigen::RowVector3d(0.2, 0.5, 0.3)})
    {
      Eigen::Vector3d at = Eigen::Vector3d::Zero(), expected = at;
      for (std::size_t k = 0; k < 3; ++k)
      {
        at += b(static_cast<int>(k)) * nodes.row(part[k]).transpose();
        if (part[k] >= 3)
          expected(part[k] - 3) += b(static_cast<int>(k));
      }
      EXPECT_LT((hats(at) - expected).norm(), 1e-15) << at.transpose();
    }
}
