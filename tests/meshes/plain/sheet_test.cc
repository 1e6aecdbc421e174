// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "tests/meshes/plain/shapes.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::meshes;

TEST(exact_sheet, the_sheet_of_the_paper_has_its_number_of_triangles_and_vertices)
{
  const Lattice lattice   = tests::square_lattice(0.01);
  const TriangleMesh cell = tests::parallelogram(lattice, 18, 20);
  const Sheet sheet       = tile(cell, lattice, 20, 20);
  EXPECT_EQ(sheet.mesh.n_triangles(), 288000);
  EXPECT_EQ(sheet.mesh.n_vertices(), (18 * 20 + 1) * (20 * 20 + 1)); // 144,761
  EXPECT_EQ(coarse_sheet(sheet.origin, lattice.vectors, 20, 20).n_triangles(), 800);
}

TEST(exact_sheet, tiling_covers_the_sheet_once_and_every_vertex_is_an_image_of_its_cell_vertex)
{
  for (const Lattice &lattice : {tests::square_lattice(0.01), tests::skewed_lattice()})
  {
    TriangleMesh cell = tests::parallelogram(lattice, 5, 4);
    tests::shake(cell, lattice, 3e-4);
    const Sheet sheet = tile(cell, lattice, 3, 2);
    EXPECT_TRUE(faults_of(sheet.mesh, "sheet").empty());
    EXPECT_EQ(boundary_loops(sheet.mesh).size(), 1u);
    EXPECT_NEAR(signed_areas(sheet.mesh).sum(), 6. * lattice.area(), 1e-12 * lattice.area());
    for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
      EXPECT_LT(
        lattice.shortest(sheet.mesh.vertices.row(v) - cell.vertices.row(sheet.cell_vertex(v)))
          .norm(),
        1e-12 * 0.01);
  }
}

TEST(exact_sheet, vertices_stand_in_equal_blocks_eighth_by_eighth)
{
  const Lattice lattice = tests::skewed_lattice();
  TriangleMesh cell     = tests::parallelogram(lattice, 5, 4);
  tests::shake(cell, lattice, 3e-4);
  const Sheet sheet = tile(cell, lattice, 3, 2);
  ASSERT_EQ(sheet.n_per_cell, 20);
  for (int block = 0; block < 6; ++block)
    for (int k = 0; k < sheet.n_per_cell; ++k)
    {
      const int v                = block * sheet.n_per_cell + k;
      const Eigen::RowVector2d f = lattice.fractional(sheet.mesh.vertices.row(v) - sheet.origin) -
                                   Eigen::RowVector2d(block % 3, block / 3);
      EXPECT_GE(f.minCoeff(), -1e-12);
      EXPECT_LT(f.maxCoeff(), 1. - 1e-3);
      EXPECT_EQ(k < sheet.begin_of_eighth[4], f(1) <= f(0) + 1e-9);
      const auto &begin = sheet.begin_of_eighth;
      const auto eighth = static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), k) -
                                                   begin.begin() - 1);
      const QuadHalf half            = eighths_of_cell.at(eighth);
      const Eigen::RowVector2d local = 2. * f - Eigen::RowVector2d(half.quad1, half.quad2);
      EXPECT_GE(local.minCoeff(), -1e-9);
      EXPECT_LT(local.maxCoeff(), 1. - 1e-3);
      EXPECT_EQ(half.is_above, local(1) > local(0) + 1e-9);
      EXPECT_EQ(sheet.cell_vertex(v), sheet.cell_vertex(k));
    }
}

TEST(tripwire_sheet, a_cell_with_another_outline_is_refused)
{
  // The same square lattice, cut along a line that is not straight.
  const Lattice lattice = tests::square_lattice(1.);
  TriangleMesh cell     = tests::parallelogram(lattice, 4, 4);
  cell.vertices(10, 0) += 0.1;
  cell.vertices(14, 0) += 0.1;
  ASSERT_TRUE(periodicity_faults(cell, lattice, "cell").empty());
  EXPECT_NE(tests::refusal([&] { tile(cell, lattice, 2, 2); }).find("no lattice lines"),
            std::string::npos);
  EXPECT_FALSE(makes_sheets(cell, lattice));
  EXPECT_TRUE(makes_sheets(tests::parallelogram(lattice, 4, 4), lattice));
}
