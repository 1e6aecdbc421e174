// SPDX-License-Identifier: MIT
// The cloth of a scene is made of the terms that the scene lists, whatever models its membrane.
#include "meshes/plain/sheet.h"
#include "tests/refusal.h"
#include "verification/drape/draped_cell.h"
#include "verification/drape/scene_cloth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr int n = 4;

meshes::ClothMesh lying()
{
  meshes::TriangleMesh rest =
    meshes::coarse_sheet(Eigen::RowVector2d::Zero(), 0.01 * Eigen::Matrix2d::Identity(), n, n);
  rest.material = Eigen::VectorXi::Zero(rest.n_triangles());
  return meshes::placed_sheet(rest, Eigen::Matrix<double, 3, 2>::Identity(),
                              Eigen::RowVector3d::Zero());
}

ClothMaterial material(const std::optional<Law> law)
{
  Eigen::Matrix3d C;
  C << 1000., 300., 0., 300., 1000., 0., 0., 0., 350.;
  return {law, {C}, {0.2}};
}

Scene scene_with(const std::set<std::string> &terms)
{
  Scene scene;
  scene.n1 = scene.n2 = n;
  scene.terms         = terms;
  return scene;
}

SceneCloth cloth_of(const Scene &scene, const std::optional<Law> law,
                    const std::set<std::string> &forced = {})
{
  return {scene, lying(), material(law), HeldMotion(scene, lying()), forced};
}

/// Kinetic energy that is left of a vibration in the plane, over what it began with.
double energy_left(const Scene &scene, const std::optional<Law> law)
{
  SceneCloth moving         = cloth_of(scene, law);
  const shell::Vectors &x   = moving.cloth().positions();
  shell::Vectors velocities = shell::Vectors::Zero(x.rows(), 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    velocities(v, 0) = 0.01 * std::cos(M_PI * x(v, 0) / (0.01 * n));
  moving.cloth().set_state(x, velocities, 0.);
  const double before = moving.cloth().kinetic_energy();
  // A hundredth of a period: implicit Euler itself takes little.
  for (int k = 0; k < 20; ++k)
    moving.step(1e-5);
  return moving.cloth().kinetic_energy() / before;
}
} // namespace

TEST(invariant_scene_cloth, the_viscosity_of_a_scene_damps_every_model_of_the_membrane)
{
  Scene viscous           = scene_with({"membrane", "damping"});
  viscous.viscosity       = 1e-4;
  const Scene elastic     = scene_with({"membrane"});
  const double without    = energy_left(elastic, Law::biot),
               corotation = energy_left(viscous, Law::biot);
  ASSERT_LT(corotation, 0.9 * without);
  // At this small strain nodal warping, too, is the linear element.
  EXPECT_NEAR(energy_left(elastic, {}), without, 1e-3);
  EXPECT_NEAR(energy_left(viscous, {}), corotation, 1e-3);
}

TEST(exact_scene_cloth, elastic_energy_and_that_of_the_weight_are_told_apart)
{
  Scene scene       = scene_with({"membrane", "gravity"});
  SceneCloth moving = cloth_of(scene, Law::biot);
  const shell::Vectors up =
    (1.1 * moving.cloth().positions()).rowwise() + Eigen::RowVector3d(0., 0., 0.5);
  moving.cloth().set_state(up, shell::Vectors::Zero(up.rows(), 3), 0.);
  const double area = 0.04 * 0.04;
  // ½ e·C·e with e = (0.1, 0.1, 0)
  EXPECT_NEAR(moving.elastic_energy(), area * 0.5 * 0.01 * 2600., 1e-12);
  EXPECT_NEAR(gravity_energy(scene, moving.cloth().masses(), up), 0.2 * area * 9.81 * 0.5, 1e-12);
  EXPECT_NEAR(moving.cloth().stored_energy(),
              moving.elastic_energy() + gravity_energy(scene, moving.cloth().masses(), up), 1e-12);
  EXPECT_TRUE(std::isnan(cloth_of(scene, {}).elastic_energy()));
  EXPECT_TRUE(std::isnan(
    gravity_energy(scene_with({"membrane"}), moving.cloth().masses(), moving.cloth().positions())));
}

TEST(invariant_scene_cloth, no_two_terms_whose_cost_is_measured_make_the_same_cloth)
{
  const auto names = [](const Scene &scene, const std::set<std::string> &forced)
  {
    std::vector<std::string> list;
    const SceneCloth moving = cloth_of(scene, Law::biot, forced);
    for (const auto &term : moving.cloth().terms())
      list.push_back(term->name() + " " + std::to_string(term->bytes()));
    return list;
  };
  const Scene bare                            = scene_with({"membrane"});
  std::vector<std::vector<std::string>> found = {names(bare, {})};
  for (const std::string &term : terms_with_a_cost(bare))
    found.push_back(names(bare, {term}));
  for (std::size_t a = 0; a < found.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_NE(found[a], found[b]) << a << ' ' << b;

  // Friction acts on the obstacles that a scene has.
  Scene with_floor = scene_with({"membrane", "obstacles"});
  with_floor.obstacles.push_back({"plane", {0., 0., -0.1, 0., 0., 1.}, ""});
  const std::vector<std::string> bare_terms = terms_with_a_cost(bare),
                                 terms      = terms_with_a_cost(with_floor);
  EXPECT_EQ(std::count(bare_terms.begin(), bare_terms.end(), "friction"), 0);
  EXPECT_EQ(std::count(terms.begin(), terms.end(), "friction"), 1);
}

TEST(exact_scene_cloth, held_vertices_of_a_scaled_sheet_are_those_at_the_same_places)
{
  Scene scene = scene_with({"membrane", "pins"});
  scene.n1    = 20;
  scene.n2    = 10;
  // Corners, the middle, and (5, 5) of the cells.
  scene.held        = {{"vertices", {0, 20, 210, 230, 115, 110}, {}}, {"top", {}, {}}};
  const Scene small = scaled(scene, 4);
  ASSERT_EQ(small.n2, 2);
  EXPECT_EQ(small.held[0].vertices, (std::vector<int>{0, 4, 10, 14, 7, 6}));
  EXPECT_TRUE(small.held[1].vertices.empty());
  EXPECT_EQ(scaled(small, 20).held[0].vertices, scene.held[0].vertices);
}

TEST(tripwire_scene_cloth,
     a_held_vertex_that_a_scaled_sheet_does_not_have_is_refused_with_its_place)
{
  Scene scene            = scene_with({"membrane", "pins"});
  scene.file             = "scene.prm";
  scene.n1               = 20;
  scene.n2               = 10;
  scene.held             = {{"vertices", {0, 43}, {}}, {"vertices", {500}, {}}};
  const std::string text = tests::refusal([&] { scaled(scene, 4); });
  for (const char *part : {"scene.prm", "held vertex 43", "(1, 2) of 20 x 10 cells", "4 x 2 cells",
                           "--cells", "held vertex 500 does not exist", "0 ... 230"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(invariant_scene_cloth, a_garment_is_not_scaled)
{
  Scene scene          = scene_with({"membrane", "handles"});
  scene.mesh_file      = "cloth.obj";
  Motion motion        = {Motion::Kind::translate, {0., 0., 0.1}, 0., 1.};
  scene.held           = {{"vertices", {7}, motion}};
  const Scene the_same = scaled(scene, 1);
  EXPECT_EQ(the_same.n1, n);
  EXPECT_EQ(the_same.held[0].vertices, scene.held[0].vertices);
  EXPECT_EQ(the_same.held[0].motion.along, motion.along);
}

TEST(tripwire_scene_cloth, bending_asked_of_a_cell_without_it_is_refused_by_name)
{
  homogenization::UnitCell cell;
  cell.name = "bare";
  cell.file = "bare.prm";
  cell.mesh = lying().rest;
  cell.lattice.vectors << 0.01 * n, 0., 0., 0.01 * n;
  cell.phases = {homogenization::isotropic("soft", 1e6, 0.3, 5e-4, 400.)};
  meshes::HomogenizedCell homogenized;
  homogenized.mesh          = cell.mesh;
  homogenized.lattice       = cell.lattice;
  homogenized.areal_density = 0.2;
  homogenized.chi.setZero(cell.mesh.n_vertices(), 6);
  homogenized.stiffness = cell.stiffness_of_phase()[0];
  Scene scene           = scene_with({"membrane", "bending"});
  scene.file            = "scene.prm";
  EXPECT_NE(tests::refusal([&]() { DrapedCell(scene, cell, homogenized, Law::biot); })
              .find("scene.prm: key `Bending stiffness` = cell: bare.prm has no D^H"),
            std::string::npos);
  // What the scene has of its own is enough; of a cell with D^H the coarse cloth takes that, the
  // fine one the plate of each phase.
  scene.bending = shell::PlateStiffness::isotropic(1e-6, 0.);
  EXPECT_EQ(tests::refusal([&]() { DrapedCell(scene, cell, homogenized, Law::biot); }), "");
  scene.bending.reset();
  const Eigen::Matrix3d D = cell.bending_stiffness_of_phase()[0];
  homogenized.bending     = {2. * D, meshes::Deflection::Zero(cell.mesh.n_vertices(), 3)};
  const DrapedCell draped(scene, cell, homogenized, Law::biot);
  EXPECT_EQ(draped.effective.bending[0].matrix(), 2. * D);
  EXPECT_EQ(draped.phases.bending[0].matrix(), D);
  EXPECT_EQ(draped.effective.plate, shell::PlateModel::by_mesh);
  EXPECT_EQ(draped.phases.plate, shell::PlateModel::edge_angles); // of every reference
}
