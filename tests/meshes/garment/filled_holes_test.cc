// SPDX-License-Identifier: MIT
#include "meshes/cloth/seams.h"
#include "meshes/garment/filled_holes.h"
#include "meshes/garment/fine_cloth.h"
#include "tests/meshes/garment/garments.h"
#include "tests/meshes/plain/shapes.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <vector>

using namespace homespun;
using namespace homespun::meshes;

namespace
{
constexpr int in_hole = 9;

/// A cell of 8 x 8 squares in which the triangles of some have the material `in_hole`: an L, with
/// vertices within its straight sides, and a square.
TriangleMesh drawn_cell(const Lattice &lattice)
{
  TriangleMesh cell = tests::parallelogram(lattice, 8, 8);
  for (int t = 0; t < cell.n_triangles(); ++t)
  {
    const int square = t / 2, i = square % 8, j = square / 8;
    const bool is_in_L = (i >= 1 && i <= 5 && j == 1) || (i >= 1 && i <= 2 && j >= 1 && j <= 5);
    cell.material(t)   = is_in_L || (i == 5 && j == 5) ? in_hole : t % 3;
  }
  return cell;
}

/// The same without those triangles, and without the vertices that they alone had.
TriangleMesh without_holes(const TriangleMesh &drawn)
{
  TriangleMesh cell;
  std::vector<int> number(static_cast<std::size_t>(drawn.n_vertices()), -1), kept, vertices;
  for (int t = 0; t < drawn.n_triangles(); ++t)
    if (drawn.material(t) != in_hole)
      kept.push_back(t);
  cell.triangles.resize(static_cast<Eigen::Index>(kept.size()), 3);
  cell.material.resize(static_cast<Eigen::Index>(kept.size()));
  for (int t = 0; t < cell.n_triangles(); ++t)
  {
    cell.material(t) = drawn.material(kept[static_cast<std::size_t>(t)]);
    for (int k = 0; k < 3; ++k)
    {
      const int v = drawn.triangles(kept[static_cast<std::size_t>(t)], k);
      int &index  = number[static_cast<std::size_t>(v)];
      if (index < 0)
      {
        index = static_cast<int>(vertices.size());
        vertices.push_back(v);
      }
      cell.triangles(t, k) = index;
    }
  }
  cell.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 2);
  for (int v = 0; v < cell.n_vertices(); ++v)
    cell.vertices.row(v) = drawn.vertices.row(vertices[static_cast<std::size_t>(v)]);
  return cell;
}

std::map<int, double> areas_of_materials(const TriangleMesh &mesh)
{
  const Eigen::VectorXd areas = signed_areas(mesh);
  std::map<int, double> sums;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    sums[mesh.material(t)] += areas(t);
  return sums;
}
} // namespace

TEST(exact_filled_holes, filled_it_is_the_cell_without_holes_and_its_own_triangles_stay)
{
  for (const Lattice &lattice : {tests::square_lattice(0.01), tests::skewed_lattice()})
  {
    const TriangleMesh cell = without_holes(drawn_cell(lattice)), filled = filled_holes(cell);
    EXPECT_EQ(boundary_loops(cell).size(), 3u);
    EXPECT_EQ(boundary_loops(filled).size(), 1u);
    EXPECT_TRUE(faults_of(filled, "filled").empty()) << faults_of(filled, "filled").front();
    EXPECT_EQ(filled.vertices, cell.vertices);
    EXPECT_EQ(filled.triangles.topRows(cell.n_triangles()), cell.triangles);
    EXPECT_NEAR(signed_areas(filled).sum(), lattice.area(), 1e-14 * lattice.area());
    // A polygon of n vertices has n - 2 triangles: 20 around the L, 4 around the square.
    EXPECT_EQ(filled.n_triangles() - cell.n_triangles(), 18 + 2);
    EXPECT_GT(tests::smallest_angle(filled), 5.);
  }
}

TEST(exact_fine_cloth_with_holes, it_is_that_of_the_drawn_cell_less_the_triangles_in_holes)
{
  const Lattice lattice    = tests::skewed_lattice();
  const TriangleMesh drawn = drawn_cell(lattice), cell = without_holes(drawn);
  for (const ClothMesh &cloth :
       {tests::ring(0.021, 0.052, 23, {0.013, -0.008}), tests::TwoPanels().cloth})
    for (const double angle : {0., 0.4})
      for (const Outline outline : {Outline::clipped, Outline::whole})
      {
        FineClothOptions options;
        options.grains        = {{{0.0037, -0.001}, angle}};
        options.outline       = outline;
        const FineCloth fine  = fine_cloth(cell, lattice, cloth, options);
        auto expected         = areas_of_materials(fine_cloth(drawn, lattice, cloth, options).rest);
        const double in_holes = expected[in_hole];
        expected.erase(in_hole);
        EXPECT_GT(in_holes, 0.1 * signed_areas(cloth.rest).sum());
        const auto found = areas_of_materials(fine.rest);
        ASSERT_EQ(found.size(), expected.size());
        for (const auto &[material, area] : expected)
          EXPECT_NEAR(found.at(material), area,
                      outline == Outline::clipped ? 1e-12 * area : 1e-9 * area);
        EXPECT_TRUE(faults_of(fine.rest, "fine").empty()) << faults_of(fine.rest, "fine").front();
        if (outline == Outline::clipped)
          EXPECT_LT(std::abs(fine.area_lost), 1e-12);
        // What was made on the rim of a hole lies in a triangle of the cell, not in the hole.
        EXPECT_LT(fine.cell_triangle.maxCoeff(), cell.n_triangles());
        if (outline == Outline::clipped)
          EXPECT_GT((fine.cell_triangle.array() >= 0).count(), 100);
      }
}

TEST(tripwire_filled_holes, a_panel_that_overlaps_itself_is_still_refused)
{
  ClothMesh cloth                 = tests::ring(0.021, 0.052, 23, {0., 0.});
  const Eigen::RowVector2d inside = cloth.rest.vertices.row(0);
  // A vertex of the inner circle beyond the outer one.
  cloth.rest.vertices.row(0) = 3. * inside;
  const TriangleMesh cell    = without_holes(drawn_cell(tests::skewed_lattice()));
  EXPECT_THROW(fine_cloth(cell, tests::skewed_lattice(), cloth), BadInput);
}
