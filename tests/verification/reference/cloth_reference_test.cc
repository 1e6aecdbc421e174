// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "shell/membrane/membrane.h"
#include "tests/verification/reference/cloth_reference_cases.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::tests;

TEST(exact_cloth_reference, free_fall_is_that_of_implicit_euler_to_round_off)
{
  // x_n = x_0 + g h² n (n + 1) / 2 and no strain, for every mass matrix, from a tilted start.
  const meshes::TriangleMesh mesh           = rectangle(0.2, 0.1, 5, 4, 0.2);
  const ClothReference::Placement placement = [](const Eigen::RowVector2d &X)
  { return Eigen::RowVector3d((tilted_plane() * X.transpose()).transpose()); };
  ClothLoads loads;
  loads.gravity = {1., 2., -g};
  for (const Law law : {Law::biot, Law::green})
    for (const unsigned int order : {1u, 2u})
      for (const bool consistent : {false, true})
      {
        ClothReference cloth(mesh, {anisotropic()}, {0.2}, options_of(law, order, consistent),
                             MPI_COMM_SELF);
        cloth.start(placement, free_everywhere, loads);
        const meshes::SpacePoints start = cloth.positions();
        for (int n = 1; n <= 4; ++n)
        {
          const ClothStep step = cloth.step(0.01);
          ASSERT_TRUE(step.reached) << step.why;
          const meshes::SpacePoints fallen =
            start.rowwise() + 1e-4 * 0.5 * n * (n + 1) * loads.gravity;
          EXPECT_LT(largest_distance(cloth.positions(), fallen), 1e-12) << order << consistent;
        }
        EXPECT_LT(cloth.stored_energy(), 1e-18);
        // All of the mass moves at 4 h g.
        EXPECT_NEAR(cloth.kinetic_energy(), 0.5 * 0.2 * 0.02 * (0.04 * loads.gravity).squaredNorm(),
                    1e-12);
        EXPECT_NEAR(cloth.time(), 0.04, 1e-15);
      }
}

TEST(exact_cloth_reference, mass_damping_slows_a_fall_as_implicit_euler_says)
{
  // (1 + alpha h) v_(n+1) = v_n + h g
  ClothLoads loads;
  loads.gravity      = {0., 0., -g};
  loads.mass_damping = 3.;
  ClothReference cloth(rectangle(0.1, 0.1, 3, 3), {anisotropic()}, {0.2},
                       options_of(Law::biot, 1, false), MPI_COMM_SELF);
  cloth.start([](const Eigen::RowVector2d &X) { return Eigen::RowVector3d(X(0), X(1), 0.); },
              free_everywhere, loads);
  double speed = 0.;
  for (int n = 0; n < 5; ++n)
  {
    ASSERT_TRUE(cloth.step(0.02).reached);
    speed = (speed - 0.02 * g) / (1. + 3. * 0.02);
  }
  const meshes::SpacePoints velocities = cloth.velocities();
  EXPECT_LT((velocities.col(2).array() - speed).abs().maxCoeff(), 1e-11);
  EXPECT_LT(velocities.leftCols<2>().cwiseAbs().maxCoeff(), 1e-11);
}

TEST(invariant_cloth_reference, a_rigidly_moved_cloth_without_loads_stays_where_it_is)
{
  const meshes::TriangleMesh mesh           = rectangle(0.2, 0.1, 5, 4, 0.2);
  const ClothReference::Placement placement = [](const Eigen::RowVector2d &X)
  {
    return Eigen::RowVector3d((tilted_plane() * X.transpose()).transpose() +
                              Eigen::RowVector3d(0.3, -1., 2.));
  };
  for (const Law law : {Law::biot, Law::green})
    for (const unsigned int order : {1u, 2u})
    {
      ClothReference cloth(mesh, {anisotropic()}, {0.2}, options_of(law, order, false),
                           MPI_COMM_SELF);
      cloth.start(placement, free_everywhere, {});
      const ClothStep step = cloth.step(0.01);
      ASSERT_TRUE(step.reached) << step.why;
      EXPECT_LT(largest_distance(cloth.positions(), images(mesh, placement)), 1e-14);
      EXPECT_EQ(step.n_newton, 0u);
    }
}

TEST(exact_cloth_reference, a_patch_held_at_its_rim_is_stretched_uniformly_in_a_tilted_plane)
{
  const meshes::TriangleMesh mesh = rectangle(0.2, 0.1, 6, 5, 0.2);
  Eigen::Matrix2d stretch;
  stretch << 1.06, 0.02, 0.01, 1.03;
  const auto placed = [&](const Eigen::RowVector2d &X)
  { return Eigen::RowVector3d((tilted_plane() * stretch * X.transpose()).transpose()); };
  const Held rim = [&](const Eigen::RowVector2d &X, double) -> std::optional<Eigen::RowVector3d>
  {
    if (X(0) < 1e-9 || X(0) > 0.2 - 1e-9 || X(1) < 1e-9 || X(1) > 0.1 - 1e-9)
      return placed(X);
    return std::nullopt;
  };
  const Eigen::RowVector3d normal = tilted_plane().col(0).cross(tilted_plane().col(1)).transpose();
  const auto pushed               = [&](const Eigen::RowVector2d &X)
  {
    const double bump = std::sin(M_PI * X(0) / 0.2) * std::sin(M_PI * X(1) / 0.1);
    return Eigen::RowVector3d(placed(X) + 0.004 * bump * normal);
  };
  for (const Law law : {Law::biot, Law::green})
    for (const unsigned int order : {1u, 2u})
    {
      ClothReference cloth(mesh, {anisotropic()}, {0.2}, options_of(law, order, false),
                           MPI_COMM_SELF);
      cloth.start(pushed, rim, {});
      const ClothStep step = cloth.solve_equilibrium(0.);
      ASSERT_TRUE(step.reached) << step.why;
      EXPECT_LT(largest_distance(cloth.positions(), images(mesh, placed)), 1e-10 * 0.2);
      EXPECT_NEAR(cloth.stored_energy(), 0.02 * response(law, anisotropic(), stretch).energy,
                  1e-12);
    }
}

TEST(exact_cloth_reference, the_elastic_energy_is_that_of_the_coarse_cloths_membrane)
{
  const meshes::TriangleMesh mesh = rectangle(0.2, 0.1, 6, 5, 0.2);
  const auto wavy                 = [](const Eigen::RowVector2d &X)
  {
    return Eigen::RowVector3d(1.05 * X(0), 0.98 * X(1) + 0.1 * X(0) * X(0),
                              0.01 * std::sin(40. * X(0)) * std::cos(30. * X(1)));
  };
  ClothReference cloth(mesh, {anisotropic()}, {0.2}, options_of(Law::biot, 1, false),
                       MPI_COMM_SELF);
  cloth.start(wavy, free_everywhere, {});
  const shell::Membrane membrane = shell::membrane(mesh, {anisotropic()});
  const double there             = shell::membrane_energy<3>(membrane, cloth.positions());
  EXPECT_NEAR(cloth.stored_energy(), there, 1e-13 * there);
}

TEST(invariant_cloth_reference, held_points_may_move_and_be_let_go)
{
  // Held at an edge that is lifted for two steps and then released: from then on the centre of mass
  // is in free fall, that is, it is accelerated by g.
  const meshes::TriangleMesh mesh = rectangle(0.1, 0.1, 4, 4);
  const Held lifted               = [](const Eigen::RowVector2d &X,
                         const double t) -> std::optional<Eigen::RowVector3d>
  {
    if (X(1) > 0.1 - 1e-9 && t < 0.025)
      return Eigen::RowVector3d(X(0), 0., X(1) + 0.05 * t);
    return std::nullopt;
  };
  ClothLoads loads;
  loads.gravity = {0., 0., -g};
  for (const unsigned int order : {1u, 2u})
  {
    ClothReference cloth(mesh, {anisotropic()}, {0.2}, options_of(Law::biot, order, false),
                         MPI_COMM_SELF);
    cloth.start([](const Eigen::RowVector2d &X) { return Eigen::RowVector3d(X(0), 0., X(1)); },
                lifted, loads);
    for (int n = 1; n <= 2; ++n)
    {
      ASSERT_TRUE(cloth.step(0.01).reached);
      EXPECT_NEAR(cloth.positions()(22, 2), 0.1 + 0.0005 * n, 1e-15);
    }
    // Momentum by the kinetic energy's mass: with P1 lumped, a third of each triangle per vertex.
    if (order == 2)
      continue;
    Eigen::VectorXd mass        = Eigen::VectorXd::Zero(mesh.n_vertices());
    const Eigen::VectorXd areas = meshes::signed_areas(mesh);
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        mass(mesh.triangles(t, k)) += 0.2 * areas(t) / 3.;
    const auto momentum = [&] { return Eigen::RowVector3d(mass.transpose() * cloth.velocities()); };
    Eigen::RowVector3d before = momentum();
    for (int n = 0; n < 3; ++n)
    {
      ASSERT_TRUE(cloth.step(0.01).reached);
      const Eigen::RowVector3d change = momentum() - before;
      EXPECT_LT((change - Eigen::RowVector3d(0., 0., -0.2 * 0.01 * 0.01 * g)).norm(),
                1e-9 * 0.2 * 0.01 * 0.01 * g);
      before = momentum();
    }
  }
}

TEST(tripwire_cloth_reference, bad_input_is_refused_with_all_faults)
{
  meshes::TriangleMesh mesh = rectangle(0.1, 0.1, 2, 2);
  mesh.material(3)          = 7;
  ClothReferenceOptions options;
  options.law = Law::linear;
  try
  {
    ClothReference cloth(mesh, {-anisotropic()}, {0.}, options, MPI_COMM_SELF);
    FAIL();
  }
  catch (const meshes::BadInput &bad)
  {
    EXPECT_EQ(bad.faults().size(), 4u) << bad.what();
  }
  ClothReference cloth(rectangle(0.1, 0.1, 2, 2), {anisotropic()}, {0.2}, {}, MPI_COMM_SELF);
  const auto nowhere = [](const Eigen::RowVector2d &)
  { return Eigen::RowVector3d(0., std::nan(""), 0.); };
  EXPECT_THROW(cloth.start(nowhere, free_everywhere, {}), meshes::BadInput);
}

TEST(tripwire_cloth_reference,
     an_equilibrium_that_does_not_exist_is_reported_and_the_cloth_left_alone)
{
  // Nothing is held: the cloth falls for ever.
  ClothReference cloth(rectangle(0.1, 0.1, 3, 3), {anisotropic()}, {0.2}, {}, MPI_COMM_SELF);
  ClothLoads loads;
  loads.gravity = {0., 0., -g};
  cloth.start([](const Eigen::RowVector2d &X) { return Eigen::RowVector3d(X(0), X(1), 0.); },
              free_everywhere, loads);
  const meshes::SpacePoints before = cloth.positions();
  const ClothStep step             = cloth.solve_equilibrium(0.);
  EXPECT_FALSE(step.reached);
  EXPECT_FALSE(step.why.empty());
  EXPECT_EQ(largest_distance(cloth.positions(), before), 0.);
  EXPECT_TRUE(cloth.step(0.01).reached);
}
