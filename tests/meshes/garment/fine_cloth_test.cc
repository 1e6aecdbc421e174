// SPDX-License-Identifier: MIT
#include "meshes/cloth/seams.h"
#include "meshes/files/obj_file.h"
#include "meshes/garment/fine_cloth.h"
#include "meshes/plain/errors.h"
#include "tests/meshes/garment/garments.h"
#include "tests/meshes/plain/shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

using namespace homespun;
using namespace homespun::meshes;

namespace
{
TriangleMesh shaken_cell(const Lattice &lattice, const int n1, const int n2)
{
  TriangleMesh cell = tests::parallelogram(lattice, n1, n2);
  tests::shake(cell, lattice, 2e-4);
  for (int t = 0; t < cell.n_triangles(); ++t)
    cell.material(t) = t % 3;
  return cell;
}

/// How far the fine cloth's area is from that of the panels, as a part of it.
double missing_area(const FineCloth &fine, const ClothMesh &cloth)
{
  const double area = signed_areas(cloth.rest).sum();
  return std::abs(signed_areas(fine.rest).sum() - area) / area;
}

/// How far the vertices are from what is said of them: images of cell vertices, points of triangles
/// of the cell, points of coarse triangles.
void expect_vertices_where_they_are_said(const FineCloth &fine, const ClothMesh &cloth,
                                         const TriangleMesh &cell, const double cell_side)
{
  const Panels panels = panels_of(cloth);
  double from_image = 0., from_cell = 0., from_coarse = 0.;
  int n_wrong_panel = 0;
  for (int v = 0; v < fine.n_vertices(); ++v)
  {
    const Grain &grain             = fine.grains[static_cast<std::size_t>(fine.panel(v))];
    const Eigen::RowVector2d X     = fine.rest.vertices.row(v),
                             local = (X - grain.origin) * grain.rotation();
    Eigen::RowVector2d in_cell = Eigen::RowVector2d::Zero(), in_coarse = in_cell;
    const bool is_image = fine.cell_vertex(v) >= 0;
    EXPECT_NE(is_image, fine.cell_triangle(v) >= 0);
    for (int k = 0; k < 3; ++k)
    {
      if (!is_image)
        in_cell +=
          fine.cell_weights(v, k) * cell.vertices.row(cell.triangles(fine.cell_triangle(v), k));
      in_coarse += fine.coarse_weights(v, k) *
                   cloth.rest.vertices.row(cloth.rest.triangles(fine.coarse_triangle(v), k));
    }
    if (is_image)
      in_cell = cell.vertices.row(fine.cell_vertex(v));
    in_cell -= cell.vertices.row(anchor_vertex(cell, fine.lattice));
    double &distance = is_image ? from_image : from_cell;
    distance         = std::max(distance, fine.lattice.shortest(local - in_cell).norm());
    from_coarse      = std::max(from_coarse, (in_coarse - X).norm());
    n_wrong_panel += panels.of_triangle(fine.coarse_triangle(v)) != fine.panel(v) ? 1 : 0;
    EXPECT_NEAR(fine.coarse_weights.row(v).sum(), 1., 1e-14);
    EXPECT_GT(fine.coarse_weights.row(v).minCoeff(), -1e-9);
  }
  EXPECT_LT(from_image,
            1.01 * outline_tolerance * cell_side); // what lies next to an outline moves onto it
  EXPECT_LT(from_cell, 1e-13 * cell_side + 1e-15);
  EXPECT_LT(from_coarse, 1e-13 * cell_side + 1e-15);
  EXPECT_EQ(n_wrong_panel, 0);
}
} // namespace

TEST(exact_fine_cloth, a_ring_is_covered_exactly_at_any_origin_and_angle_of_the_cells)
{
  const Lattice lattice   = tests::skewed_lattice();
  const TriangleMesh cell = shaken_cell(lattice, 7, 6);
  const ClothMesh cloth   = tests::ring(0.021, 0.052, 23, {0.013, -0.008});
  for (const double angle : {0., 0.4, 2.})
    for (const double shift : {0., 0.0037})
    {
      FineClothOptions options;
      options.grains       = {{{shift, -0.3 * shift}, angle}};
      const FineCloth fine = fine_cloth(cell, lattice, cloth, options);
      EXPECT_LT(missing_area(fine, cloth), 1e-14);
      EXPECT_TRUE(faults_of(fine.rest, "fine").empty()) << faults_of(fine.rest, "fine").front();
      EXPECT_EQ(boundary_loops(fine.rest).size(), 2u);
      EXPECT_EQ(tests::topology_of(fine.rest.triangles).euler, 0);
      EXPECT_EQ(fine.n_slivers, 0);
      // Round-off of a sum of some 1e4 areas.
      EXPECT_LT(std::abs(fine.area_lost), 1e-13 * signed_areas(cloth.rest).sum());
      EXPECT_GT(fine.n_cut, 100);
      EXPECT_TRUE(fine.seam_distance.array().isInf().all());
      expect_vertices_where_they_are_said(fine, cloth, cell, 0.01);
    }
}

TEST(exact_fine_cloth, panels_that_lie_far_from_the_origin_are_covered_as_well)
{
  const Lattice lattice   = tests::skewed_lattice();
  const TriangleMesh cell = shaken_cell(lattice, 7, 6);
  const ClothMesh cloth   = tests::ring(0.021, 0.052, 23, {1e4, -2e4});
  const FineCloth fine    = fine_cloth(cell, lattice, cloth);
  EXPECT_EQ(tests::topology_of(fine.rest.triangles).euler, 0);
  EXPECT_LT(missing_area(fine, cloth), 1e-9); // coordinates of 2e4 m are known to 4e-12 m
}

TEST(exact_fine_cloth, a_panel_whose_sides_are_lattice_lines_is_the_tiled_sheet)
{
  for (const Lattice &lattice : {tests::square_lattice(0.01), tests::skewed_lattice()})
  {
    const TriangleMesh cell = shaken_cell(lattice, 5, 4);
    const Sheet sheet       = tile(cell, lattice, 4, 3);
    const ClothMesh cloth   = placed_sheet(coarse_sheet(sheet.origin, lattice.vectors, 4, 3),
                                           Eigen::Matrix<double, 3, 2>::Identity(), {0., 0., 0.});
    for (const Outline outline : {Outline::clipped, Outline::whole})
    {
      FineClothOptions options;
      options.grains[0].origin = sheet.origin;
      options.outline          = outline;
      const FineCloth fine     = fine_cloth(cell, lattice, cloth, options);
      EXPECT_EQ(fine.rest.n_triangles(), sheet.mesh.n_triangles());
      EXPECT_EQ(fine.n_vertices(), sheet.mesh.n_vertices());
      EXPECT_EQ(fine.n_cut, 0);
      EXPECT_LT(missing_area(fine, cloth), 1e-14);
      EXPECT_EQ(fine.rest.material.sum(), sheet.mesh.material.sum());
      expect_vertices_where_they_are_said(fine, cloth, cell, 0.01);
    }
  }
}

TEST(exact_fine_cloth,
     outlines_that_miss_the_lattice_lines_by_less_than_a_file_says_make_no_slivers)
{
  const Lattice lattice   = tests::square_lattice(0.01);
  const TriangleMesh cell = shaken_cell(lattice, 5, 4);
  TriangleMesh coarse     = coarse_sheet({0., 0.}, lattice.vectors, 4, 3);
  for (int v = 0; v < coarse.n_vertices(); ++v)
    coarse.vertices.row(v) += 5e-9 * Eigen::RowVector2d(std::sin(v), std::cos(3. * v));
  const ClothMesh cloth =
    placed_sheet(coarse, Eigen::Matrix<double, 3, 2>::Identity(), {0., 0., 0.});
  const FineCloth fine = fine_cloth(cell, lattice, cloth);
  EXPECT_EQ(fine.rest.n_triangles(), 12 * cell.n_triangles());
  EXPECT_LT(missing_area(fine, cloth), 1e-14);
}

TEST(exact_fine_cloth, outlines_at_any_small_distance_from_the_lattice_lines_are_covered)
{
  // Distances of 1e-4 to 1e-12 of a cell: some vertices move onto the outline, some do not.
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> random(0., 1.);
  for (int k = 0; k < 300; ++k)
  {
    const Lattice lattice   = k % 2 == 0 ? tests::square_lattice(0.01) : tests::skewed_lattice();
    const TriangleMesh cell = shaken_cell(lattice, 1 + k % 6, 1 + k / 6 % 6);
    TriangleMesh coarse     = coarse_sheet({0., 0.}, lattice.vectors / (1 + k % 3), 5, 4);
    const double distance   = 0.01 * std::pow(10., -4. - 8. * random(generator));
    for (int v = 0; v < coarse.n_vertices(); ++v)
      coarse.vertices.row(v) +=
        distance * Eigen::RowVector2d(random(generator) - 0.5, random(generator) - 0.5);
    const ClothMesh cloth =
      placed_sheet(coarse, Eigen::Matrix<double, 3, 2>::Identity(), {0., 0., 0.});
    const FineCloth fine = fine_cloth(cell, lattice, cloth);
    EXPECT_LT(missing_area(fine, cloth), 1e-14);
    EXPECT_GT(signed_areas(fine.rest).minCoeff(), 1e-12 * lattice.area());
    EXPECT_EQ(tests::topology_of(fine.rest.triangles).euler, 1);
    EXPECT_EQ(fine.n_slivers, 0);
  }
}

TEST(exact_fine_cloth, panels_smaller_than_a_fine_triangle_are_covered)
{
  const Lattice lattice   = tests::square_lattice(1.);
  const TriangleMesh cell = tests::parallelogram(lattice, 1, 1);
  const ClothMesh cloth   = tests::ring(0.05, 0.1, 9, {0.71, 0.28});
  const FineCloth fine    = fine_cloth(cell, lattice, cloth);
  EXPECT_LT(missing_area(fine, cloth), 1e-14);
  EXPECT_EQ(tests::topology_of(fine.rest.triangles).euler, 0);
}

TEST(exact_fine_cloth, two_panels_share_all_points_of_their_seam)
{
  const Lattice lattice   = tests::skewed_lattice();
  const TriangleMesh cell = shaken_cell(lattice, 7, 6);
  const ClothMesh cloth   = tests::TwoPanels().cloth;
  FineClothOptions options;
  options.grains       = {{{0., 0.}, 0.1}, {{0.31, 0.2}, -0.5}};
  const FineCloth fine = fine_cloth(cell, lattice, cloth, options);
  EXPECT_LT(missing_area(fine, cloth), 1e-14);
  expect_vertices_where_they_are_said(fine, cloth, cell, 0.01);
  const tests::Topology apart = tests::topology_of(fine.rest.triangles),
                        sewn  = tests::topology_of(fine.sewn_triangles());
  EXPECT_EQ(apart.euler, 2); // two discs
  EXPECT_EQ(sewn.euler, 1);  // one
  EXPECT_EQ(sewn.n_branching, 0);
  int n_sewn = 0;
  for (int v = 0; v < fine.n_vertices(); ++v)
    if (const int first = fine.same_in_space(v); first != v)
    {
      ++n_sewn;
      EXPECT_NE(fine.panel(v), fine.panel(first));
      EXPECT_LT(fine.seam_distance(v), 1e-15);
      EXPECT_LT(fine.seam_distance(first), 1e-15);
    }
  EXPECT_GT(n_sewn, 40); // 5 coarse edges, each crossed by the triangles of a cell on both sides
  EXPECT_EQ(apart.n_open - sewn.n_open, 2 * (n_sewn - 1));
}

TEST(exact_fine_cloth, the_shipped_skirt_becomes_one_ring_without_gaps)
{
  const ClothMesh skirt   = read_cloth(HOMESPUN_SOURCE_DIR "/meshes/scenes/skirt.obj");
  const Lattice lattice   = tests::square_lattice(0.01);
  const TriangleMesh cell = shaken_cell(lattice, 6, 6);
  const FineCloth fine    = fine_cloth(cell, lattice, skirt);
  EXPECT_LT(missing_area(fine, skirt), 1e-13);
  EXPECT_EQ(tests::topology_of(fine.rest.triangles).euler, 4); // four gores
  EXPECT_EQ(tests::topology_of(fine.sewn_triangles()).euler, 0);
  EXPECT_EQ(tests::topology_of(fine.sewn_triangles()).n_branching, 0);
  expect_vertices_where_they_are_said(fine, skirt, cell, 0.01);
}

TEST(exact_fine_cloth, the_distance_to_a_seam_is_the_nearest_of_its_edges)
{
  const Lattice lattice = tests::skewed_lattice();
  const tests::TwoPanels garment;
  const FineCloth fine = fine_cloth(shaken_cell(lattice, 7, 6), lattice, garment.cloth);
  const auto seams     = seam_edges(garment.cloth);
  ASSERT_EQ(seams.size(), 5u);
  for (int v = 0; v < fine.n_vertices(); ++v)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const SeamEdge &seam : seams)
    {
      const auto ends =
        rest_ends(garment.cloth, seam.sides[static_cast<std::size_t>(fine.panel(v))]);
      const Eigen::RowVector2d from = garment.cloth.rest.vertices.row(ends[0]),
                               span = garment.cloth.rest.vertices.row(ends[1]) - from,
                               to   = fine.rest.vertices.row(v) - from;
      for (int k = 0; k <= 1000; ++k)
        nearest = std::min(nearest, (to - k / 1000. * span).norm());
    }
    if (nearest > 0.99 * seam_reach * std::sqrt(lattice.area()))
      continue;
    EXPECT_NEAR(fine.seam_distance(v), nearest, 6e-6);
  }
}

TEST(exact_fine_cloth, left_out_triangles_leave_only_those_of_the_cell_and_their_area_is_told)
{
  const Lattice lattice   = tests::skewed_lattice();
  const TriangleMesh cell = shaken_cell(lattice, 7, 6);
  const ClothMesh cloth   = tests::ring(0.021, 0.052, 23, {0.013, -0.008});
  FineClothOptions options;
  options.grains[0].angle = 0.4;
  const FineCloth clipped = fine_cloth(cell, lattice, cloth, options);
  options.outline         = Outline::whole;
  const FineCloth whole   = fine_cloth(cell, lattice, cloth, options);
  EXPECT_EQ(whole.outline, Outline::whole);
  EXPECT_EQ(whole.n_cut, clipped.n_cut);
  EXPECT_GE(whole.cell_vertex.minCoeff(), 0);
  EXPECT_LT(whole.rest.n_triangles(), clipped.rest.n_triangles());
  const double panel = signed_areas(cloth.rest).sum(), covered = signed_areas(whole.rest).sum();
  EXPECT_NEAR(whole.area_lost, panel - covered, 1e-15);
  EXPECT_GT(whole.area_lost, 0.01 * panel);
  // Every triangle is congruent to one of the cell's.
  const Eigen::VectorXd areas = signed_areas(whole.rest), of_cell = signed_areas(cell);
  for (int t = 0; t < areas.size(); ++t)
    EXPECT_LT((of_cell.array() - areas(t)).abs().minCoeff(), 1e-17);
  // No more could stay: of the triangles that were cut none lies wholly inside.
  EXPECT_LT(whole.area_lost, clipped.n_cut * of_cell.maxCoeff());
}

TEST(exact_fine_cloth, a_slit_without_width_stays_open)
{
  // A square with a cut from its middle to its right side: two rows of rest vertices at the same
  // place.
  const Lattice lattice   = tests::square_lattice(0.01);
  const TriangleMesh cell = shaken_cell(lattice, 5, 4);
  TriangleMesh coarse = coarse_sheet({0.0013, 0.0021}, 0.01 * Eigen::Matrix2d::Identity(), 4, 4);
  const int n         = coarse.n_vertices();
  coarse.vertices.conservativeResize(n + 2, 2);
  coarse.vertices.row(n)     = coarse.vertices.row(2 * 5 + 3);
  coarse.vertices.row(n + 1) = coarse.vertices.row(2 * 5 + 4);
  for (int t = 16; t < 32; ++t) // the triangles above the cut
    for (int k = 0; k < 3; ++k)
      if (int &v = coarse.triangles(t, k); v == 2 * 5 + 3 || v == 2 * 5 + 4)
        v = v == 2 * 5 + 3 ? n : n + 1;
  const ClothMesh cloth =
    placed_sheet(coarse, Eigen::Matrix<double, 3, 2>::Identity(), {0., 0., 0.});
  const FineCloth fine = fine_cloth(cell, lattice, cloth);
  EXPECT_LT(missing_area(fine, cloth), 1e-14);
  EXPECT_EQ(tests::topology_of(fine.rest.triangles).euler, 1);
  int n_above = 0, n_below = 0;
  for (int v = 0; v < fine.n_vertices(); ++v)
    if (std::abs(fine.rest.vertices(v, 1) - coarse.vertices(n, 1)) < 1e-12 &&
        fine.rest.vertices(v, 0) > coarse.vertices(12, 0) + 1e-9)
      ++(fine.coarse_triangle(v) >= 16 ? n_above : n_below);
  EXPECT_GT(n_above, 9);
  EXPECT_EQ(n_above, n_below);
}

TEST(tripwire_fine_cloth, faults_are_named)
{
  const Lattice lattice   = tests::square_lattice(0.01);
  const TriangleMesh cell = tests::parallelogram(lattice, 3, 3);
  const ClothMesh cloth   = tests::TwoPanels().cloth;
  const auto refusal      = [&](const ClothMesh &given, const FineClothOptions &options = {})
  {
    try
    {
      fine_cloth(cell, lattice, given, options);
      return std::string();
    }
    catch (const BadInput &fault)
    {
      return std::string(fault.what());
    }
  };
  const auto expect = [](const std::string &text, const std::string &part)
  { EXPECT_NE(text.find(part), std::string::npos) << text; };
  FineClothOptions options;
  options.grains.resize(3);
  expect(refusal(cloth, options), "found 3 grains; expected 1, or 2, one per panel");
  options.grains.resize(1);
  options.grains[0].angle = std::nan("");
  expect(refusal(cloth, options), "grain 0 has an origin or an angle that is not a finite number");
  ClothMesh bad       = cloth;
  bad.triangles(3, 0) = -1;
  expect(refusal(bad), "fine cloth: triangle 3 names vertex -1");
  bad = cloth;
  bad.rest.vertices *= 1e5;
  expect(refusal(bad), "is vt in metres?");
  bad = cloth;
  bad.rest.vertices *= 1e-3;
  options.grains[0].angle = 0.;
  options.outline         = Outline::whole;
  expect(refusal(bad, options), "no triangle of the cell lies wholly inside a panel");
  // A strip that turns once and a bit around a circle overlaps itself at rest.
  TriangleMesh spiral = coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), 40, 1);
  for (int v = 0; v < spiral.n_vertices(); ++v)
  {
    const double angle = 0.2 * spiral.vertices(v, 0), radius = 0.05 - 0.01 * spiral.vertices(v, 1);
    spiral.vertices.row(v) << radius * std::cos(angle), radius * std::sin(angle);
  }
  expect(refusal(placed_sheet(spiral, Eigen::Matrix<double, 3, 2>::Identity(), {0., 0., 0.})),
         "the outline of panel 0 is at odds with itself near the rest point (0.0");
}
