// SPDX-License-Identifier: MIT
// A moving cloth of yarns: what it must keep, and where it comes to rest.
#include "meshes/plain/errors.h"
#include "shell/terms/law_terms.h"
#include "shell/terms/yarn_term.h"
#include "tests/refusal.h"
#include "tests/shell/solver/cloth_cases.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::shell;
using namespace homespun::tests;

namespace
{
/// Of the tests' fabric, but under the law of yarns.
struct WovenFabric
{
  explicit WovenFabric(const meshes::ClothMesh &mesh, const std::vector<int> &held = {},
                       const ClothOptions &options = {})
      : masses(lumped_masses(mesh, {0.2}))
      , cloth(mesh.positions, masses, held, options)
  {
    cloth.add(yarn_term(mesh, {anisotropic()}));
  }
  Eigen::VectorXd masses;
  Cloth cloth;
};
} // namespace

TEST(invariant_yarn_term, any_rigid_motion_has_no_force_and_any_motion_no_force_as_a_whole)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  WovenFabric fabric(mesh);
  std::mt19937 generator(1);
  for (const double angle : {0.4, 2., 5.})
  {
    Vectors x = mesh.positions * rotation<3>(angle).transpose();
    fabric.cloth.set_state(x, Vectors::Zero(x.rows(), 3), 0.);
    EXPECT_LT(fabric.cloth.gradient().cwiseAbs().maxCoeff(), 1e-13 * anisotropic().norm());
    x += 0.01 * random_matrix<Vectors>(generator, x.rows(), 3);
    fabric.cloth.set_state(x, Vectors::Zero(x.rows(), 3), 0.);
    const Vectors forces      = fabric.cloth.gradient();
    Eigen::RowVector3d torque = Eigen::RowVector3d::Zero();
    for (Eigen::Index v = 0; v < x.rows(); ++v)
      torque += Eigen::RowVector3d(x.row(v)).cross(Eigen::RowVector3d(forces.row(v)));
    EXPECT_LT(forces.colwise().sum().norm(), 1e-13 * forces.norm());
    EXPECT_LT(torque.norm(), 1e-13 * forces.norm());
  }
}

TEST(bound_yarn_term, a_sheet_that_falls_into_its_clamps_loses_energy_in_every_step_and_holds)
{
  // Slack at first, so that triangles are compressed: the steps need the positive part.
  const int n                  = 8;
  const meshes::ClothMesh mesh = lying_sheet(n);
  for (const Integrator integrator : {Integrator::linearly_implicit, Integrator::implicit})
  {
    ClothOptions options;
    options.integrator = integrator;
    WovenFabric fabric(mesh, {0, n}, options);
    fabric.cloth.add(gravity_term(fabric.masses, earth));
    double before = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
    for (int step = 0; step < 100; ++step)
    {
      fabric.cloth.step(0.005);
      const double now = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
      EXPECT_LE(now, before + 1e-9 * std::abs(before)) << step;
      before = now;
    }
    EXPECT_TRUE(fabric.cloth.positions().allFinite());
    EXPECT_GT(fabric.cloth.positions().col(2).minCoeff(), -0.35); // its diagonal is 28 cm
  }
}

TEST(exact_yarn_term, a_sheet_pulled_in_space_is_the_one_in_its_plane)
{
  const int n                  = 5;
  const meshes::ClothMesh mesh = lying_sheet(n);
  std::vector<int> held;
  Vectors moved = mesh.positions;
  for (int i = 0; i <= n; ++i)
    for (const int v : {i, n * (n + 1) + i})
      held.push_back(v);
  for (int i = 0; i <= n; ++i)
    moved(n * (n + 1) + i, 1) += 0.01;
  WovenFabric fabric(mesh, held);
  fabric.cloth.set_state(moved, Vectors::Zero(moved.rows(), 3), 0.);
  fabric.cloth.solve_equilibrium(1e-11);
  Membrane flat = membrane(mesh.rest, {anisotropic()});
  take_yarn_law(flat);
  const auto in_plane =
    MembraneSolver(flat, held).solve_equilibrium(Positions<2>(moved.leftCols<2>()), {1e-12, 50});
  EXPECT_LT((fabric.cloth.positions().leftCols<2>() - in_plane.positions).cwiseAbs().maxCoeff(),
            1e-7 * 0.2);
  EXPECT_LT(fabric.cloth.positions().col(2).cwiseAbs().maxCoeff(), 1e-7 * 0.2);
}

TEST(tripwire_yarn_term, a_stiffness_without_axes_is_named)
{
  const meshes::ClothMesh mesh = lying_sheet(2);
  EXPECT_NE(refusal([&] { yarn_term(mesh, {isotropic(1., 0.3)}); })
              .find("law yarn: the stiffness of every phase is alike in all directions"),
            std::string::npos);
}

// A yarn without length has an infinite energy: of a free sheet that is a point nothing pulls any
// vertex away from another, and no step leads out of it.
TEST(tripwire_yarn_term, a_free_sheet_that_is_a_point_is_refused_by_the_yarn_without_length)
{
  const meshes::ClothMesh mesh = lying_sheet(4);
  for (const Integrator integrator :
       {Integrator::linearly_implicit, Integrator::implicit, Integrator::conserving})
    for (const double h : {1e-3, 0.02})
    {
      ClothOptions options;
      options.integrator = integrator;
      WovenFabric fabric(mesh, {}, options);
      fabric.cloth.add(gravity_term(fabric.masses, earth));
      const Vectors point = Vectors::Zero(mesh.n_vertices(), 3);
      fabric.cloth.set_state(point, point, 0.);
      const std::string text = refusal([&] { fabric.cloth.step(h); });
      EXPECT_NE(text.find("triangle 0: a yarn without length"), std::string::npos) << text;
      EXPECT_NE(text.find("whose energy is infinite"), std::string::npos) << text;
      EXPECT_EQ(fabric.cloth.positions(), point); // the state is that before the step
    }
}

// Held apart by two corners it is pulled out of the point, or refused.
TEST(tripwire_yarn_term, a_sheet_that_is_a_point_but_for_its_handles_moves_or_names_the_yarn)
{
  const int n                  = 4;
  const meshes::ClothMesh mesh = lying_sheet(n);
  for (const Integrator integrator : {Integrator::linearly_implicit, Integrator::implicit})
    for (const double h : {1e-3, 0.02})
    {
      ClothOptions options;
      options.integrator = integrator;
      WovenFabric fabric(mesh, {0, n}, options);
      fabric.cloth.add(gravity_term(fabric.masses, earth));
      Vectors x = Vectors::Zero(mesh.n_vertices(), 3);
      x.row(n)  = mesh.positions.row(n) - mesh.positions.row(0);
      fabric.cloth.set_state(x, Vectors::Zero(mesh.n_vertices(), 3), 0.);
      EXPECT_TRUE(std::isinf(fabric.cloth.stored_energy()));
      std::string text;
      for (int step = 0; step < 5 && text.empty(); ++step)
        text = refusal([&] { fabric.cloth.step(h); });
      if (text.empty())
        EXPECT_TRUE(std::isfinite(fabric.cloth.stored_energy()));
      else
        EXPECT_NE(text.find(": a yarn without length, whose energy is infinite: "),
                  std::string::npos)
          << text;
      EXPECT_TRUE(fabric.cloth.positions().allFinite());
    }
}

TEST(tripwire_law_terms, only_a_law_of_coarse_cloths_has_terms_and_each_of_them_has_some)
{
  const meshes::ClothMesh mesh = lying_sheet(2);
  for (const meshes::Law law : meshes::all_laws())
  {
    const auto text =
      refusal([&] { EXPECT_FALSE(law_terms(law, mesh, nullptr, {anisotropic()}, 0.).empty()); });
    if (properties_of(law).is_of_coarse_cloth)
      EXPECT_EQ(text, "") << name_of(law);
    else
      EXPECT_NE(text.find("law `" + name_of(law) + "`: a moving cloth does not have it"),
                std::string::npos)
        << text;
  }
}
