// SPDX-License-Identifier: MIT
#include "meshes/cloth/seams.h"
#include "meshes/files/obj_file.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

#include <unistd.h>

using namespace homespun;
using namespace homespun::meshes;

namespace
{
/// A file that goes away.
struct TemporaryFile
{
  explicit TemporaryFile(const std::string &name, const std::string &content = "")
      : path((std::filesystem::temp_directory_path() /
              ("homespun-" + std::to_string(::getpid()) + "-" + name))
               .string())
  {
    std::ofstream(path) << content;
  }
  ~TemporaryFile()
  {
    std::filesystem::remove(path);
  }
  std::string path;
};

template <typename Action>
std::vector<std::string> faults_of_action(const Action &action)
{
  try
  {
    action();
    return {};
  }
  catch (const BadInput &input)
  {
    return input.faults();
  }
}

std::vector<std::string> faults_of_cloth(const std::string &content)
{
  const TemporaryFile file("cloth.obj", content);
  return faults_of_action([&] { read_cloth(file.path); });
}

void expect_fault(const std::vector<std::string> &faults, const std::string &part)
{
  for (const std::string &fault : faults)
    if (fault.find(part) != std::string::npos)
      return;
  std::string all;
  for (const std::string &fault : faults)
    all += fault + "\n";
  ADD_FAILURE() << "no fault says `" << part << "` among\n" << all;
}

/// Two square panels of 2 x 2 squares, sewn along one side; in space one flat strip.
ClothMesh strip_of_two()
{
  const TriangleMesh left = coarse_sheet({0., 0.}, 0.05 * Eigen::Matrix2d::Identity(), 2, 2);
  const int n = left.n_vertices(), m = left.n_triangles();
  ClothMesh cloth;
  cloth.rest.vertices.resize(2 * n, 2);
  cloth.rest.vertices << left.vertices, left.vertices.rowwise() + Eigen::RowVector2d(0.3, 0.1);
  cloth.rest.triangles.resize(2 * m, 3);
  cloth.rest.triangles << left.triangles, left.triangles.array() + n;
  cloth.rest.material.setZero(2 * m);
  // In space: columns 0, 1, 2 of the left panel, then columns 1 and 2 of the right one.
  cloth.positions.resize(15, 3);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 5; ++i)
      cloth.positions.row(5 * j + i) << 0.05 * i, 0.05 * j, 1.;
  cloth.triangles.resize(2 * m, 3);
  for (int t = 0; t < 2 * m; ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int v = cloth.rest.triangles(t, k), local = v % n;
      cloth.triangles(t, k) = 5 * (local / 3) + local % 3 + (v < n ? 0 : 2);
    }
  return cloth;
}

std::vector<std::string> faults_after(const std::function<void(ClothMesh &)> &harm)
{
  ClothMesh cloth = strip_of_two();
  harm(cloth);
  return cloth_faults(cloth, "strip");
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

/// The strip with vertex 15 in space, 18 at rest, and a triangle 16 that the caller fills.
void with_room_for_a_junction(ClothMesh &cloth, const Eigen::RowVector3d &position,
                              const Eigen::RowVector2d &rest)
{
  cloth.positions.conservativeResize(16, 3);
  cloth.positions.row(15) = position;
  cloth.rest.vertices.conservativeResize(19, 2);
  cloth.rest.vertices.row(18) = rest;
  cloth.triangles.conservativeResize(17, 3);
  cloth.rest.triangles.conservativeResize(17, 3);
  cloth.rest.material.setZero(17);
}
} // namespace

TEST(exact_obj_file, comments_groups_quads_negative_indices_and_line_ends_are_read)
{
  const std::string content = "# a cloth\r\nmtllib a.mtl\no cloth\n" + square +
                              "vn 0 0 1\nusemtl a\ng b\ns off\nf 1/1/1 2/2/1 3/3/1 4/4/1 # quad\n"
                              "v +2 0 0 0.5 0.5 0.5\nv 2e0 1 0\nvt 2 0 0\nvt 2 1\n"
                              "f 2/2 -2/-2 \\\n -1/-1\nf 2/2 6/6 3/3 \\";
  const TemporaryFile file("good.obj", content);
  const ClothMesh cloth = read_cloth(file.path, 0.5);
  ASSERT_EQ(cloth.n_triangles(), 4);
  ASSERT_EQ(cloth.n_vertices(), 6);
  EXPECT_EQ(cloth.rest.n_vertices(), 6);
  EXPECT_DOUBLE_EQ(signed_areas(cloth.rest).sum(), 0.5);
  EXPECT_EQ(cloth.positions(4, 0), 2.);
  EXPECT_EQ(cloth.rest.vertices.row(5), Eigen::RowVector2d(1., 0.5));
  EXPECT_EQ(panels_of(cloth).count, 1);
  EXPECT_TRUE(seam_edges(cloth).empty());
}

TEST(exact_obj_file, a_quadrilateral_with_a_re_entrant_corner_is_cut_through_it)
{
  const TemporaryFile file("dart.obj", "v 0 0 0\nv 1 0 0\nv 0.2 0.2 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                                       "vt 0.2 0.2\nvt 0 1\nf 1/1 2/2 3/3 4/4\nf 2/2 4/4 3/3\n");
  const ClothMesh cloth = read_cloth(file.path);
  EXPECT_GT(signed_areas(cloth.rest).minCoeff(), 0.09);
  EXPECT_DOUBLE_EQ(signed_areas(cloth.rest).sum(), 0.5);
}

TEST(invariant_obj_file, a_cloth_survives_writing_and_reading_to_the_last_bit)
{
  ClothMesh cloth = strip_of_two();
  cloth.positions.array() += 1. / 3.;
  cloth.rest.vertices *= std::sqrt(2.);
  const TemporaryFile file("round.obj");
  write_obj(file.path, cloth);
  const ClothMesh again = read_cloth(file.path);
  EXPECT_EQ(again.positions, cloth.positions);
  EXPECT_EQ(again.triangles, cloth.triangles);
  EXPECT_EQ(again.rest.vertices, cloth.rest.vertices);
  EXPECT_EQ(again.rest.triangles, cloth.rest.triangles);
  EXPECT_FALSE(std::filesystem::exists(file.path + ".part"));
}

TEST(exact_obj_file, layers_that_share_vt_are_panels_of_their_own)
{
  const TemporaryFile file("stacked.obj",
                           square + "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1/1 2/2 3/3 4/4\n"
                                    "f 5/1 6/2 7/3 8/4\n");
  const ClothMesh cloth = read_cloth(file.path);
  EXPECT_EQ(panels_of(cloth).count, 2);
  EXPECT_EQ(cloth.rest.n_vertices(), 8);
}

TEST(exact_obj_file, a_vt_for_each_corner_of_a_face_makes_no_panels)
{
  const TemporaryFile file("wedges.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                         "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 0\nvt 1 1\nvt 0 1\n"
                                         "f 1/1 2/2 3/3\nf 1/4 3/5 4/6\n");
  const ClothMesh cloth = read_cloth(file.path);
  EXPECT_EQ(cloth.rest.n_vertices(), 4);
  EXPECT_EQ(cloth.rest.triangles.row(1), Eigen::RowVector3i(0, 2, 3));
}

TEST(exact_obj_file, panels_that_meet_in_a_point_stay_apart)
{
  // Two gores of a cap, on top of each other in vt, sewn along one side each and at the apex.
  const TemporaryFile file("gores.obj", "v 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\n"
                                        "vt 0 1\nvt -0.4 0\nvt 0.4 0\nvt 0 1\nvt -0.4 0\nvt 0.4 0\n"
                                        "f 1/1 2/2 3/3\nf 1/4 3/5 4/6\n");
  EXPECT_EQ(read_cloth(file.path).rest.n_vertices(), 6);
}

TEST(exact_obj_file, a_comment_ends_with_its_line)
{
  const TemporaryFile file("comment.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                                          "# from D:\\cloth\\\nf 1/1 2/2 3/3\n");
  EXPECT_EQ(read_cloth(file.path).n_triangles(), 1);
}

TEST(tripwire_obj_file, faults_of_lines_are_named_with_file_and_line)
{
  expect_fault(faults_of_action([] { read_cloth("/nowhere/cloth.obj"); }),
               "/nowhere/cloth.obj: cannot be read");
  expect_fault(faults_of_cloth("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
               "line 4: the face has no vt: cloth without vt: export UV coordinates in metres");
  expect_fault(faults_of_cloth(square + "f 1/1 2/2 7/3\n"),
               "line 9: the face names v `7`; expected 1 to 4");
  expect_fault(faults_of_cloth(square + "f 1/1 2/2 -5/3\n"), "the face names v `-5`");
  expect_fault(faults_of_cloth(square + "f 1/1 2/2 3/0\n"), "the face names vt `0`");
  expect_fault(faults_of_cloth(square + "f 1/1 2/2\n"), "line 9: the face has 2 corners");
  expect_fault(faults_of_cloth("v 0 nan 0\n"), "line 1: found `nan`; expected a finite number");
  expect_fault(faults_of_cloth("v 0 1e999 0\n"), "line 1: found `1e999`");
  expect_fault(faults_of_cloth("v 0 1\n"), "line 1: `v` has 2 numbers; expected 3");
  expect_fault(faults_of_cloth(square + "l 1 2\n"), "line 9: found `l`; expected v, vt or f");
  expect_fault(faults_of_cloth(square), "has no face");
  const auto many = faults_of_cloth("v a 0 0\nv b 0 0\nv c 0 0\nv d 0 0\nv e 0 0\n");
  EXPECT_EQ(many.size(), 4u);
  expect_fault(many, "and 2 more coordinates that are not finite numbers");
}

TEST(tripwire_cloth_faults, each_fault_is_named)
{
  EXPECT_TRUE(faults_after([](ClothMesh &) {}).empty());
  expect_fault(faults_after([](ClothMesh &c) { c.rest.vertices.resize(0, 2); }),
               "cloth without vt: export UV coordinates in metres");
  expect_fault(faults_after([](ClothMesh &c) { c.triangles(3, 1) = 15; }),
               "triangle 3 names vertex 15; expected 0 to 14");
  expect_fault(faults_after([](ClothMesh &c) { c.rest.triangles(3, 1) = -1; }),
               "triangle 3 names rest vertex -1");
  expect_fault(faults_after([](ClothMesh &c)
                            { c.positions(2, 2) = std::numeric_limits<double>::quiet_NaN(); }),
               "vertex 2 has coordinates that are not finite");
  expect_fault(faults_after([](ClothMesh &c) { c.rest.vertices.row(4) = c.rest.vertices.row(0); }),
               "has no area at rest");
  expect_fault(faults_after(
                 [](ClothMesh &c)
                 {
                   c.rest.vertices.row(4) << 0.12, 0.07; // the middle of panel 0, pulled out of it
                 }),
               "is flipped at rest");
  expect_fault(faults_after([](ClothMesh &c) { c.rest.vertices.bottomRows(9).col(0) *= -1.; }),
               "panel 1 (8 triangles, triangle 8 is one of them) is mirrored at rest");
  expect_fault(faults_after(
                 [](ClothMesh &c)
                 {
                   c.triangles.row(1)      = c.triangles.row(0);
                   c.rest.triangles.row(1) = c.rest.triangles.row(0);
                 }),
               "triangle 1 repeats triangle 0");
  expect_fault(faults_after([](ClothMesh &c) { c.triangles(15, 0) = 0; }), "rest vertex ");
  expect_fault(faults_after([](ClothMesh &c)
                            { c.positions.conservativeResizeLike(SpacePoints::Zero(16, 3)); }),
               "vertex 15 at (0, 0, 0) m belongs to no triangle");
}

TEST(tripwire_cloth_faults, a_third_panel_on_a_seam_is_named_with_its_edge)
{
  const ClothMesh strip = strip_of_two();
  ClothMesh cloth       = strip;
  cloth.positions.conservativeResize(16, 3);
  cloth.positions.row(15) << 0.1, 0.02, 1.1;
  cloth.rest.vertices.conservativeResize(21, 2);
  cloth.rest.vertices.bottomRows(3) << 1., 0., 1., 0.05, 0.95, 0.;
  cloth.triangles.conservativeResize(17, 3);
  cloth.triangles.row(16) << 2, 7, 15; // the seam's lower edge
  cloth.rest.triangles.conservativeResize(17, 3);
  cloth.rest.triangles.row(16) << 18, 19, 20;
  cloth.rest.material.setZero(17);
  expect_fault(cloth_faults(cloth, "strip"), "strip: the edge between vertices 2 and 7 near");
  expect_fault(cloth_faults(cloth, "strip"), "belongs to 3 triangles");
}

TEST(tripwire_cloth_faults, a_panel_that_is_sewn_on_inside_out_is_named)
{
  // Both panels counter-clockwise at rest, but one shows its back.
  const auto faults = faults_after(
    [](ClothMesh &c)
    {
      c.triangles.bottomRows(8).col(1).swap(c.triangles.bottomRows(8).col(2));
      c.rest.triangles.bottomRows(8).col(1).swap(c.rest.triangles.bottomRows(8).col(2));
      c.rest.vertices.bottomRows(9).col(0) *= -1.;
    });
  expect_fault(faults, "the edge between vertices 2 and 7 near");
  expect_fault(faults, "is traversed the same way by triangles");
  EXPECT_EQ(faults.size(), 2u);
}

TEST(tripwire_cloth_faults, t_junctions_are_named_in_a_panel_and_on_a_seam_wherever_the_cloth_lies)
{
  for (const double place : {0., 1e4})
  {
    const auto shifted = [&](ClothMesh &c)
    {
      c.positions.array() += place;
      c.rest.vertices.array() += place;
    };
    EXPECT_TRUE(faults_after(shifted).empty());
    // Within panel 0: triangles 0 and 1 become one square cut along the other diagonal, its edge to
    // the next square split on one side only.
    const auto in_panel = faults_after(
      [&](ClothMesh &c)
      {
        with_room_for_a_junction(c, {0.05, 0.025, 1.}, {0.05, 0.025});
        c.triangles.row(0) << 0, 1, 15;
        c.rest.triangles.row(0) << 0, 1, 18;
        c.triangles.row(16) << 0, 15, 6;
        c.rest.triangles.row(16) << 0, 18, 4;
        shifted(c);
      });
    expect_fault(in_panel, "rest vertex 18 at (");
    expect_fault(in_panel, "lies inside the edge between rest vertices 1 and 4 of panel 0");
    EXPECT_EQ(in_panel.size(), 1u);
    // On the seam: panel 1 has a vertex more there than panel 0.
    const auto on_seam = faults_after(
      [&](ClothMesh &c)
      {
        with_room_for_a_junction(c, {0.1, 0.025, 1.}, {0.3, 0.125});
        c.triangles.row(9) << 2, 8, 15; // was 2, 8, 7
        c.rest.triangles.row(9) << 9, 13, 18;
        c.triangles.row(16) << 15, 8, 7;
        c.rest.triangles.row(16) << 18, 13, 12;
        shifted(c);
      });
    expect_fault(on_seam, "vertex 15 at (");
    expect_fault(on_seam, "lies inside the edge between vertices 2 and 7 in space");
    EXPECT_EQ(on_seam.size(), 1u);
  }
}

TEST(invariant_cloth_faults, a_panel_may_lie_folded_flat_on_itself)
{
  // A towel, the columns beyond 21 mm turned over onto those before.
  const std::vector<double> columns = {0., 0.009, 0.021, 0.03, 0.041};
  ClothMesh cloth;
  cloth.rest = coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), 4, 2);
  cloth.positions.setZero(cloth.rest.n_vertices(), 3);
  for (int v = 0; v < cloth.rest.n_vertices(); ++v)
  {
    const double x = columns[static_cast<std::size_t>(v % 5)], y = 0.02 * (v / 5);
    cloth.rest.vertices.row(v) << x, y;
    cloth.positions.row(v) << std::min(x, 0.042 - x), y, 0.;
  }
  cloth.triangles = cloth.rest.triangles;
  EXPECT_EQ(cloth_faults(cloth, "towel"), std::vector<std::string>());
}

TEST(invariant_cloth_faults, the_verdicts_do_not_change_with_unit_and_place)
{
  for (const double unit : {1e-6, 1., 1e6})
  {
    ClothMesh cloth = strip_of_two();
    cloth.positions *= unit;
    cloth.rest.vertices *= unit;
    EXPECT_TRUE(cloth_faults(cloth, "strip").empty());
    cloth.rest.vertices.row(4) = 0.5 * (cloth.rest.vertices.row(0) + cloth.rest.vertices.row(8));
    EXPECT_TRUE(cloth_faults(cloth, "strip").empty());
    cloth.rest.vertices(4, 0) += 0.0500001 * unit;
    expect_fault(cloth_faults(cloth, "strip"), "is flipped at rest");
    cloth.rest.vertices(4, 0) = cloth.rest.vertices(1, 0) + 0.05 * unit * (1. - 1e-13);
    expect_fault(cloth_faults(cloth, "strip"), "has no area at rest");
  }
}

TEST(exact_seams, a_strip_of_two_panels_has_two_seam_edges)
{
  const ClothMesh cloth = strip_of_two();
  const Panels panels   = panels_of(cloth);
  EXPECT_EQ(panels.count, 2);
  EXPECT_EQ(panels.of_triangle.sum(), 8);
  const auto seams = seam_edges(cloth);
  ASSERT_EQ(seams.size(), 2u);
  for (const SeamEdge &seam : seams)
  {
    const auto first = space_ends(cloth, seam.sides[0]), second = space_ends(cloth, seam.sides[1]);
    EXPECT_EQ(first[0], second[1]);
    EXPECT_EQ(first[1], second[0]);
    EXPECT_NE(panels.of_triangle(seam.sides[0].triangle),
              panels.of_triangle(seam.sides[1].triangle));
  }
}

TEST(tripwire_surface_file, faults_of_an_obstacle_are_named)
{
  const auto faults = [](const std::string &faces)
  {
    const TemporaryFile file("ball.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + faces);
    return faults_of_action([&] { read_surface(file.path); });
  };
  EXPECT_TRUE(faults("f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n").empty());
  expect_fault(faults_of_action([] { read_surface("/nowhere/ball.obj"); }),
               "/nowhere/ball.obj: cannot be read");
  expect_fault(faults("f 1 3 2\nf 1 2 4\nf 2 3 4\n"), "the edge between vertices 0 and 2 near");
  expect_fault(faults("f 1 3 2\nf 1 2 4\nf 2 3 4\n"), "expected a closed surface");
  expect_fault(faults("f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"), "is traversed the same way");
  expect_fault(faults("f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"), "the surface is inside out");
  expect_fault(faults("f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nv 1 1 1\nf 1 2 5\n"),
               "belongs to 3 triangles (0, 1, 4)");
  expect_fault(faults("f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nv 1 1 1\n"),
               "vertex 4 at (1, 1, 1) m belongs to no triangle");
}
