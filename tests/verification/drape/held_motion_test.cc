// SPDX-License-Identifier: MIT
// What is held, on the coarse and on the fine cloth of one scene.
#include "homogenization/cell/unit_cell.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/refusal.h"
#include "verification/drape/draped_cell.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
Scene sheet_with(const std::vector<HeldPlace> &held)
{
  Scene scene;
  scene.file = "scene.prm";
  scene.n1   = 3;
  scene.n2   = 4;
  scene.held = held;
  return scene;
}

DrapedCell draped(const Scene &scene)
{
  meshes::HomogenizedCell unused;
  unused.stiffness     = Eigen::Matrix3d::Identity();
  unused.areal_density = 1.;
  return {scene, homogenization::read_unit_cell(CELLS "layered.prm"), unused, Law::biot};
}

HeldPlace turned(const std::string &place, const std::vector<int> &vertices = {})
{
  Motion motion;
  motion.kind    = Motion::Kind::rotate;
  motion.along   = {0., 0., 1.};
  motion.angle   = 0.5 * M_PI;
  motion.seconds = 1.;
  return {place, vertices, motion};
}
} // namespace

TEST(exact_held_motion, vertices_of_the_coarse_sheet_are_held_where_they_are_on_the_fine_one)
{
  // (i, j) has the index 4 j + i.
  const std::vector<int> wanted = {0, 6, 13, 19};
  const DrapedCell cloth        = draped(sheet_with({{"vertices", wanted, {}}}));
  const std::vector<int> coarse = cloth.coarse_motion().vertices(cloth.coarse),
                         fine   = cloth.fine_motion().vertices(cloth.fine);
  EXPECT_EQ(coarse, wanted);
  ASSERT_EQ(fine.size(), wanted.size());
  for (const int v : wanted)
  {
    double nearest = 1.;
    for (const int f : fine)
      nearest = std::min(
        nearest, (cloth.fine.rest.vertices.row(f) - cloth.coarse.rest.vertices.row(v)).norm());
    EXPECT_LT(nearest, 1e-12) << v;
  }
}

// What cells may miss their edges by, as where coordinates are of single precision, edges of sheets
// may, too.
TEST(exact_held_motion, rounded_coordinates_of_a_cell_hold_all_vertices_of_an_edge)
{
  meshes::HomogenizedCell unused;
  unused.stiffness                     = Eigen::Matrix3d::Identity();
  unused.areal_density                 = 1.;
  const homogenization::UnitCell exact = homogenization::read_unit_cell(CELLS "layered.prm");
  homogenization::UnitCell rounded     = exact;
  const double side                    = std::sqrt(exact.lattice.area());
  for (int v = 0; v < rounded.mesh.n_vertices(); ++v)
    rounded.mesh.vertices.row(v) += 3e-8 * side * Eigen::RowVector2d(v % 3 - 1, v % 2);
  for (const char *place : {"left", "right", "bottom", "top", "top left"})
  {
    const auto n_held = [&](const homogenization::UnitCell &cell)
    {
      const DrapedCell cloth(sheet_with({{place, {}, {}}}), cell, unused, Law::biot);
      return cloth.fine_motion().vertices(cloth.fine).size();
    };
    EXPECT_EQ(n_held(rounded), n_held(exact)) << place;
  }
  const std::vector<int> corners = {0, 6, 19};
  const DrapedCell cloth(sheet_with({{"vertices", corners, {}}}), rounded, unused, Law::biot);
  EXPECT_EQ(cloth.fine_motion().vertices(cloth.fine).size(), corners.size());
}

TEST(exact_held_motion, both_cloths_turn_held_vertices_about_the_mean_of_those)
{
  const std::vector<int> wanted = {0, 1, 4};
  const DrapedCell cloth        = draped(sheet_with({turned("vertices", wanted)}));
  Eigen::RowVector3d centre     = Eigen::RowVector3d::Zero();
  for (const int v : wanted)
    centre += cloth.coarse.positions.row(v) / 3.;
  for (const auto &[motion, mesh] :
       {std::pair(cloth.coarse_motion(), cloth.coarse), std::pair(cloth.fine_motion(), cloth.fine)})
    for (const int v : motion.vertices(mesh))
    {
      const Eigen::RowVector3d arm = mesh.positions.row(v) - centre,
                               expected(centre(0) - arm(1), centre(1) + arm(0),
                                        mesh.positions(v, 2));
      EXPECT_LT((motion.position(v, mesh, 2.) - expected).norm(), 1e-12) << v;
    }
}

TEST(exact_held_motion, vertices_of_a_garment_are_held_on_its_fine_cloth_and_turn_about_one_centre)
{
  Scene scene                     = sheet_with({turned("waist")});
  scene.mesh_file                 = CELLS "../scenes/skirt.obj";
  const DrapedCell whole          = draped(scene);
  const HeldMotion coarse_waist   = whole.coarse_motion();
  const std::vector<int> of_waist = coarse_waist.vertices(whole.coarse);
  ASSERT_GT(of_waist.size(), 3u);
  scene.held              = {turned("vertices", {of_waist[0], of_waist[2]})};
  const DrapedCell cloth  = draped(scene);
  const HeldMotion coarse = cloth.coarse_motion(), fine = cloth.fine_motion();
  const std::vector<int> on_fine = fine.vertices(cloth.fine);
  ASSERT_EQ(on_fine.size(), 2u);
  for (const int v : coarse.vertices(cloth.coarse))
  {
    const Eigen::RowVector3d start = cloth.coarse.positions.row(v);
    double nearest = 1., apart = 1.;
    for (const int f : on_fine)
      if (const double d = (cloth.fine.positions.row(f) - start).norm(); d < nearest)
      {
        nearest = d;
        apart = (fine.position(f, cloth.fine, 0.7) - coarse.position(v, cloth.coarse, 0.7)).norm();
      }
    EXPECT_LT(nearest, 1e-9) << v;
    EXPECT_LT(apart, 1e-9) << v;
  }
  // The waist turns about the same centre too, however its fine vertices are spread.
  const HeldMotion fine_waist = whole.fine_motion();
  const std::vector<int> all  = fine_waist.vertices(whole.fine);
  for (const int v : of_waist)
  {
    const Eigen::RowVector3d end = coarse_waist.position(v, whole.coarse, 2.);
    double nearest               = 1.;
    for (const int f : all)
      nearest = std::min(nearest, (fine_waist.position(f, whole.fine, 2.) - end).norm());
    EXPECT_LT(nearest, 1e-9) << v;
  }
}

TEST(tripwire_held_motion, a_garments_vertex_that_the_fine_cloth_has_not_is_refused_by_number)
{
  // Within a panel a coarse vertex is no lattice point, all but by accident.
  Scene scene            = sheet_with({turned("vertices", {0, 203, 207})});
  scene.mesh_file        = CELLS "../scenes/skirt.obj";
  const DrapedCell cloth = draped(scene);
  EXPECT_EQ(cloth.coarse_motion().vertices(cloth.coarse).size(), 3u);
  const std::string text = tests::refusal([&] { cloth.fine_motion(); });
  for (const char *part :
       {"held vertex 203", "held vertex 207", "no vertex of the full-resolution one"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(tripwire_held_motion, a_place_that_later_ones_take_away_is_named)
{
  const DrapedCell cloth =
    draped(sheet_with({{"left", {}, {}}, {"top left", {}, {}}, turned("left")}));
  const std::vector<std::string> expected = {"left", "top left"};
  EXPECT_EQ(cloth.coarse_motion().idle_places(cloth.coarse), expected);
}
