// SPDX-License-Identifier: MIT
#include "meshes/plain/drawn_lattice.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/lattice.h"
#include "tests/meshes/plain/shapes.h"

#include <gtest/gtest.h>

#include <map>

using namespace homespun;
using namespace homespun::meshes;

TEST(exact_lattice, images_on_a_structured_outline_form_the_classes_that_counting_gives)
{
  for (const Lattice &lattice : {tests::square_lattice(0.01), tests::skewed_lattice()})
  {
    const TriangleMesh mesh    = tests::parallelogram(lattice, 6, 5);
    const ImageClasses classes = match_images(mesh.vertices, lattice);
    std::map<int, int> vertices_in_classes_of_size;
    for (const int size : classes.size)
      ++vertices_in_classes_of_size[size];
    EXPECT_EQ(vertices_in_classes_of_size[4], 4);                   // the corners
    EXPECT_EQ(vertices_in_classes_of_size[2], 2 * (6 - 1 + 5 - 1)); // pairs on the sides
    EXPECT_EQ(vertices_in_classes_of_size[1], (6 - 1) * (5 - 1));
    for (int v = 0; v < mesh.n_vertices(); ++v)
    {
      const int r = classes.representative[static_cast<std::size_t>(v)];
      const Eigen::RowVector2d image =
        mesh.vertices.row(r) + classes.offset.row(v).cast<double>() * lattice.vectors;
      EXPECT_LT((image - mesh.vertices.row(v)).norm(), 1e-15);
      EXPECT_LE(r, v);
    }
  }
}

TEST(invariant_lattice, classes_do_not_change_with_units_or_origin)
{
  const Lattice lattice   = tests::skewed_lattice();
  const TriangleMesh mesh = tests::parallelogram(lattice, 7, 4);
  const auto before       = match_images(mesh.vertices, lattice).representative;
  for (const double scale : {1e-9, 1e-3, 1e3, 1e9})
  {
    const Lattice scaled = {scale * lattice.vectors};
    Points points        = scale * mesh.vertices;
    points.rowwise() += 3. * scaled.vectors.row(0) + 0.37 * scaled.vectors.row(1);
    EXPECT_EQ(match_images(points, scaled).representative, before);
  }
}

TEST(exact_lattice, the_frame_of_a_parallelogram_and_its_outline_give_back_its_lattice)
{
  for (const Lattice &lattice : {tests::square_lattice(0.02), tests::skewed_lattice()})
  {
    const TriangleMesh mesh          = tests::parallelogram(lattice, 3, 4);
    const std::vector<Frame> frames  = frames_of(mesh, 1e-9);
    const std::vector<Lattice> whole = lattices_of_outline(mesh, 1e-9);
    ASSERT_FALSE(frames.empty());
    ASSERT_EQ(whole.size(), 1u) << "corners onto corners: no brick bond";
    EXPECT_LT((frames[0].lattice.vectors - lattice.vectors).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_TRUE(is_same_lattice(whole[0], lattice));
  }
}

TEST(exact_lattice, the_first_vector_of_a_frame_is_nearest_to_the_x_axis_however_the_cell_is_turned)
{
  for (const double degrees : {-44., -1., -1e-5, 0., 1e-5, 1., 44.})
  {
    const double c = std::cos(degrees * M_PI / 180.), s = std::sin(degrees * M_PI / 180.);
    Lattice lattice;
    lattice.vectors << c, s, -s, c;
    const TriangleMesh mesh = tests::parallelogram(lattice, 3, 4);
    EXPECT_LT(
      (frames_of(mesh, 1e-9).front().lattice.vectors - lattice.vectors).cwiseAbs().maxCoeff(),
      1e-14)
      << degrees;
  }
}

TEST(exact_lattice, round_off_does_not_choose_the_first_vector_of_a_rhombus)
{
  Lattice lattice;
  lattice.vectors << 1., 0.5, -1., 0.5;
  for (const double off : {-1e-12, 0., 1e-12})
  {
    TriangleMesh mesh = tests::parallelogram(lattice, 2, 2);
    mesh.vertices.col(1) += off * mesh.vertices.col(0);
    EXPECT_LT(
      (frames_of(mesh, 1e-9).front().lattice.vectors - lattice.vectors).cwiseAbs().maxCoeff(),
      1e-11)
      << off;
  }
}

TEST(exact_lattice, a_cell_is_anchored_where_both_vectors_begin_whatever_they_are)
{
  const TriangleMesh mesh = tests::parallelogram(tests::square_lattice(1.), 3, 4);
  for (const auto &[vectors, corner] :
       {std::pair<Eigen::Matrix2d, Eigen::RowVector2d>(
          (Eigen::Matrix2d() << 1., 0., 0., 1.).finished(), {0., 0.}),
        {(Eigen::Matrix2d() << -1., 0., 0., -1.).finished(), {1., 1.}},
        {(Eigen::Matrix2d() << 0., 1., -1., 0.).finished(), {1., 0.}}})
  {
    const Lattice lattice = {vectors};
    EXPECT_EQ(mesh.vertices.row(anchor_vertex(mesh, lattice)), corner);
    const Sheet sheet = tile(mesh, lattice, 2, 3);
    EXPECT_EQ(sheet.origin, corner);
    EXPECT_EQ(sheet.mesh.n_triangles(), 6 * mesh.n_triangles());
  }
}

TEST(exact_lattice, the_outline_of_a_plus_of_five_squares_fills_the_plane_in_two_ways)
{
  // The cross pentomino, which is not the square that frames it.
  const TriangleMesh square = tests::parallelogram(tests::square_lattice(3.), 3, 3);
  TriangleMesh plus         = square;
  std::vector<int> kept;
  for (int t = 0; t < square.n_triangles(); ++t)
    if ((t / 2 % 3 == 1) || (t / 6 == 1))
      kept.push_back(t);
  plus.triangles = square.triangles(kept, Eigen::all);
  plus.material.setZero(plus.n_triangles());
  const std::vector<Lattice> found = lattices_of_outline(plus, 1e-9);
  ASSERT_EQ(found.size(), 2u);
  for (const Lattice &lattice : found)
    EXPECT_NEAR(lattice.area(), 5., 1e-12);
  EXPECT_FALSE(is_same_lattice(found[0], found[1])) << "one is the mirror image of the other";
  EXPECT_NEAR(frames_of(plus, 1e-9).back().lattice.area(), 9., 1e-12);
}

TEST(exact_lattice, a_sound_cell_has_no_faults_and_its_lower_left_corner_is_the_anchor)
{
  const Lattice lattice   = tests::skewed_lattice();
  const TriangleMesh mesh = tests::parallelogram(lattice, 3, 4);
  EXPECT_TRUE(faults_of(mesh, "cell").empty());
  EXPECT_TRUE(periodicity_faults(mesh, lattice, "cell").empty());
  EXPECT_EQ(anchor_vertex(mesh, lattice), 0);
}

TEST(tripwire_lattice, two_vertices_of_the_outline_within_the_tolerance_are_named)
{
  const Lattice lattice = tests::square_lattice(1.);
  for (const double gap : {5e-8, 2e-7})
  {
    TriangleMesh mesh = tests::parallelogram(lattice, 2, 4);
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if (mesh.vertices(v, 1) == 0.25)
        mesh.vertices(v, 1) = gap; // a row of needles above the lower side
    const std::vector<std::string> faults = periodicity_faults(mesh, lattice, "cell.msh");
    ASSERT_EQ(faults.size(), gap < 1e-7 ? 1u : 0u) << gap;
    if (!faults.empty())
    {
      EXPECT_NE(faults[0].find("cell.msh: vertices "), std::string::npos) << faults[0];
      EXPECT_NE(faults[0].find("count as one; expected more than 1e-07 m"), std::string::npos)
        << faults[0];
    }
  }
}

TEST(tripwire_lattice, two_vertices_inside_within_the_tolerance_are_named)
{
  // Both ends of the short edge would be one vertex to whoever matches images: corners, sheets,
  // tables of chi.
  const Lattice lattice = tests::square_lattice(1.);
  for (const double gap : {5e-8, 2e-7})
  {
    TriangleMesh mesh                     = tests::parallelogram(lattice, 4, 4);
    mesh.vertices.row(12)                 = mesh.vertices.row(6) + Eigen::RowVector2d(0., gap);
    const std::vector<std::string> faults = periodicity_faults(mesh, lattice, "cell.msh");
    ASSERT_EQ(faults.size(), gap < 1e-7 ? 1u : 0u) << gap;
    if (!faults.empty())
    {
      EXPECT_NE(faults[0].find("vertices 6 at"), std::string::npos) << faults[0];
      EXPECT_NE(faults[0].find("and 12 at"), std::string::npos) << faults[0];
    }
  }
}

TEST(tripwire_lattice, a_moved_boundary_vertex_is_named_with_its_candidate_and_the_remedy)
{
  const Lattice lattice = tests::square_lattice(1.);
  TriangleMesh mesh     = tests::parallelogram(lattice, 4, 4);
  mesh.vertices(9, 1) += 1e-3; // on the right side, at height 0.25
  const std::vector<std::string> faults = periodicity_faults(mesh, lattice, "cell.msh");
  ASSERT_EQ(faults.size(), 2u); // neither the vertex nor its partner has an image
  EXPECT_NE(faults[0].find("cell.msh: vertex"), std::string::npos);
  EXPECT_NE((faults[0] + faults[1]).find("vertex 9 at"), std::string::npos);
  EXPECT_NE(faults[0].find("off by 0.001 m"), std::string::npos);
  EXPECT_NE(faults[0].find("Periodic Curve"), std::string::npos);
}

TEST(tripwire_lattice, a_lattice_of_the_wrong_size_is_refused)
{
  const TriangleMesh mesh = tests::parallelogram(tests::square_lattice(1.), 4, 4);
  const auto faults       = periodicity_faults(mesh, tests::square_lattice(1.1), "cell.msh");
  ASSERT_FALSE(faults.empty());
  EXPECT_NE(faults[0].find("encloses 1 m^2"), std::string::npos);
  EXPECT_NE(faults[0].find("span 1.21 m^2"), std::string::npos);
}

TEST(tripwire_lattice, parallel_lattice_vectors_are_refused)
{
  Lattice parallel;
  parallel.vectors << 1., 2., 2., 4.;
  const auto faults =
    periodicity_faults(tests::parallelogram(tests::square_lattice(1.), 2, 2), parallel, "cell.msh");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("parallel"), std::string::npos);
}

TEST(tripwire_mesh, inverted_flat_and_duplicate_triangles_are_each_named)
{
  TriangleMesh mesh = tests::parallelogram(tests::square_lattice(1.), 2, 2);
  EXPECT_TRUE(faults_of(mesh, "m").empty());

  TriangleMesh inverted = mesh;
  std::swap(inverted.triangles(3, 0), inverted.triangles(3, 1));
  EXPECT_NE(faults_of(inverted, "m")[0].find("triangle 3 near"), std::string::npos);
  EXPECT_NE(faults_of(inverted, "m")[0].find("inverted"), std::string::npos);

  TriangleMesh flat    = mesh;
  flat.vertices.row(0) = 0.5 * (flat.vertices.row(1) + flat.vertices.row(4));
  EXPECT_NE(faults_of(flat, "m")[0].find("triangle 0"), std::string::npos);

  TriangleMesh twice     = mesh;
  twice.triangles.row(5) = twice.triangles.row(2);
  bool named             = false;
  for (const std::string &fault : faults_of(twice, "m"))
    named |= fault.find("triangle 5 repeats triangle 2") != std::string::npos;
  EXPECT_TRUE(named);
}

TEST(tripwire_mesh, overlapping_triangles_are_found_by_the_area_they_cover)
{
  // A second, smaller square laid over the first one, with vertices of its own.
  const Lattice lattice    = tests::square_lattice(1.);
  TriangleMesh mesh        = tests::parallelogram(lattice, 4, 4);
  const TriangleMesh patch = tests::parallelogram(tests::square_lattice(0.3), 1, 1);
  const int n = mesh.n_vertices(), m = mesh.n_triangles();
  mesh.vertices.conservativeResize(n + 4, 2);
  mesh.vertices.bottomRows(4) = patch.vertices.array() + 0.3;
  mesh.triangles.conservativeResize(m + 2, 3);
  mesh.triangles.bottomRows(2) = patch.triangles.array() + n;
  mesh.material.setZero(m + 2);
  const auto faults = periodicity_faults(mesh, lattice, "cell.msh");
  ASSERT_FALSE(faults.empty());
  EXPECT_NE(faults[0].find("overlap"), std::string::npos);
}

TEST(exact_mesh, a_hole_is_a_second_loop_and_not_a_fault)
{
  const Lattice lattice = tests::square_lattice(1.);
  TriangleMesh mesh     = tests::parallelogram(lattice, 3, 3);
  // Take out the two triangles of the middle square.
  Triangles kept(16, 3);
  kept << mesh.triangles.topRows(8), mesh.triangles.bottomRows(8);
  mesh.triangles = kept;
  mesh.material.setZero(16);
  EXPECT_TRUE(faults_of(mesh, "cell").empty());
  ASSERT_EQ(boundary_loops(mesh).size(), 2u);
  EXPECT_EQ(outline(mesh).size(), 12u);
  EXPECT_TRUE(periodicity_faults(mesh, lattice, "cell").empty());
}
