// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "shell/terms/bending.h"
#include "shell/terms/warping.h"
#include "tests/refusal.h"
#include "tests/shell/solver/cloth_cases.h"

#include <gtest/gtest.h>

#include <limits>
#include <tuple>

using namespace homespun;
using namespace homespun::shell;
using namespace homespun::tests;

TEST(exact_cloth, free_fall_is_that_of_the_integrator)
{
  // x_n = x_0 + h² g n (n + 1)/2, and straight: the sheet stays what it was.
  for (const Integrator integrator : {Integrator::linearly_implicit, Integrator::implicit})
  {
    const meshes::ClothMesh mesh = lying_sheet(6);
    ClothOptions options;
    options.integrator = integrator;
    Fabric fabric(mesh, {}, options);
    fabric.cloth.add(gravity_term(fabric.masses, earth));
    const double h = 0.01;
    const int n    = 100;
    for (int k = 0; k < n; ++k)
      fabric.cloth.step(h);
    const Vectors expected = mesh.positions.rowwise() + h * h * earth * (0.5 * n * (n + 1));
    EXPECT_LT((fabric.cloth.positions() - expected).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_NEAR(fabric.cloth.time(), n * h, 1e-12);
  }
}

TEST(bound_cloth, a_sheet_clamped_on_four_sides_holds_and_the_warped_nodes_of_the_paper_fall)
{
  const int n                  = 8;
  const meshes::ClothMesh mesh = lying_sheet(n);
  const std::vector<int> held  = outline_of(mesh.rest);
  const Eigen::Matrix3d D      = isotropic(1000., 0.3);
  Fabric exact(mesh, held, {}, D, 0.01);
  Cloth nodal(mesh.positions, exact.masses, held);
  nodal.add(nodal_warping_term(mesh, {D}, exact.masses));
  for (Cloth *cloth : {&exact.cloth, &nodal})
    cloth->add(gravity_term(exact.masses, earth));
  const double h = 0.005;
  const int k    = 100;
  double deepest = 0.;
  for (int step = 0; step < k; ++step)
  {
    exact.cloth.step(h);
    nodal.step(h);
    deepest = std::min(deepest, exact.cloth.positions().col(2).minCoeff());
  }
  const double fall = 0.5 * 9.81 * h * h * k * (k + 1);
  EXPECT_GT(deepest, -0.02);
  EXPECT_LT(nodal.positions().col(2).minCoeff(), -0.9 * fall);
}

// Near the end a step gains less than the rounding of the energy. That is a sum which cancels where
// the sheet lies as high as its weight stretches it, and that of a weight where it hangs high up.
TEST(bound_cloth, an_equilibrium_is_found_to_round_off_however_high_the_sheet_hangs)
{
  for (const auto &[n, young, bending] : {std::tuple{8, 5000., 1e-4}, {10, 500., 1e-4}})
  {
    const auto solved =
      [&, n = n, young = young, bending = bending](const double height, const double tolerance)
    {
      const meshes::ClothMesh mesh =
        meshes::placed_sheet(lying_sheet(n).rest, Eigen::Matrix<double, 3, 2>::Identity(),
                             Eigen::RowVector3d(0., 0., height));
      Fabric fabric(mesh, {0, n}, {}, isotropic(young, 0.3));
      fabric.cloth.add(gravity_term(fabric.masses, earth));
      fabric.cloth.add(bending_term(mesh, {PlateStiffness::isotropic(bending, 0.3)}));
      fabric.cloth.solve_equilibrium(tolerance);
      return fabric.cloth.stored_energy();
    };
    const double energy = solved(0., 1e-8), weight_of_it = solved(1., 1e-8) - energy;
    for (const double height : {0., -energy / weight_of_it, 1., 100.})
      for (const double tolerance : {1e-8, 1e-10, 1e-12})
        EXPECT_NO_THROW(solved(height, tolerance)) << n << " " << height << " " << tolerance;
  }
}

// The energy of hinges is a sum of what cancels: in a stiff ribbon its round-off exceeds what a
// step gains long before the forces balance.
TEST(exact_cloth, a_stiff_ribbon_on_hinges_droops_as_a_beam)
{
  const int columns = 40, rows = 2;
  const double side = 0.005, density = 0.2;
  const meshes::ClothMesh mesh = meshes::placed_sheet(
    meshes::coarse_sheet({0., 0.}, side * Eigen::Matrix2d::Identity(), columns, rows),
    Eigen::Matrix<double, 3, 2>::Identity(), Eigen::RowVector3d::Zero());
  std::vector<int> held;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (v % (columns + 1) < 2)
      held.push_back(v);
  for (const double D : {0.004, 0.008, 0.0133, 0.0145479848})
  {
    Fabric fabric(mesh, held, {}, isotropic(5000., 0.));
    fabric.cloth.add(gravity_term(fabric.masses, earth));
    fabric.cloth.add(bending_term(mesh, {PlateStiffness::isotropic(D, 0.)}));
    fabric.cloth.solve_equilibrium();
    // The first hinge stands for the half cell before it; what beams know of small droops holds for
    // droop over reach within 5 % here.
    const double clamp = 0.5 * side, length = columns * side - clamp,
                 droop = density * 9.81 * std::pow(length, 3) / (8. * D);
    const auto tip     = fabric.cloth.positions().row(columns);
    EXPECT_NEAR(-tip(2) / (tip(0) - clamp) / droop, 1., 0.05) << D;
  }
}

TEST(exact_cloth, a_hanging_strip_stretches_under_its_own_weight)
{
  // nu = 0, one dimension: u(s) = rho g (L s − s²/2)/E below the held edge, E e = tension, linear
  // in U.
  const int n       = 8;
  const double side = 0.2, young = 50., density = 0.2;
  meshes::ClothMesh mesh = lying_sheet(n);
  Eigen::Matrix<double, 3, 2> standing;
  standing << 1., 0., 0., 0., 0., 1.;
  mesh = meshes::placed_sheet(mesh.rest, standing, Eigen::RowVector3d::Zero());
  std::vector<int> held;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.rest.vertices(v, 1) > side * (1. - 1e-9))
      held.push_back(v);
  Fabric fabric(mesh, held, {}, isotropic(young, 0.));
  fabric.cloth.add(gravity_term(fabric.masses, earth));
  fabric.cloth.solve_equilibrium(1e-10);
  double worst = 0.;
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const double s = side - mesh.rest.vertices(v, 1);
    const double expected =
      mesh.positions(v, 2) - density * 9.81 / young * (side * s - 0.5 * s * s);
    worst = std::max(worst, std::abs(fabric.cloth.positions()(v, 2) - expected));
  }
  // Second order in the mesh: the sag at the lower edge is 0.785 mm.
  EXPECT_LT(worst, 0.02 * density * 9.81 / young * 0.5 * side * side);
}

TEST(order_cloth, implicit_euler_is_of_first_order_in_the_time_step)
{
  const meshes::ClothMesh mesh = lying_sheet(4);
  ClothOptions options;
  options.integrator = Integrator::implicit;
  const auto end     = [&](const double h)
  {
    Fabric fabric(mesh, {0, 4}, options, isotropic(20., 0.3), 0.02);
    fabric.cloth.add(gravity_term(fabric.masses, earth));
    for (int k = 0; k < static_cast<int>(std::lround(0.08 / h)); ++k)
      fabric.cloth.step(h);
    return fabric.cloth.positions();
  };
  std::vector<double> steps, errors;
  const Vectors exact = 2. * end(0.08 / 1024) - end(0.08 / 512);
  for (const int n : {16, 32, 64, 128})
  {
    steps.push_back(0.08 / n);
    errors.push_back((end(0.08 / n) - exact).norm());
  }
  EXPECT_NEAR(slope(steps, errors), 1., 0.1);
}

TEST(exact_cloth, moving_handles_pull_the_cloth_along)
{
  // All edges moved by an affine map, slowly: the inside follows, as in the patch test.
  const meshes::ClothMesh mesh = lying_sheet(6);
  const std::vector<int> held  = outline_of(mesh.rest);
  Fabric fabric(mesh, held, {}, anisotropic(), 0.1);
  Eigen::Matrix3d F;
  F << 1.1, 0.03, 0., -0.02, 1.05, 0., 0.2, 0.1, 1.;
  const int n = 40;
  for (int k = 1; k <= n + 200; ++k)
  {
    const double part = std::min(1., double(k) / n);
    for (const int v : held)
      fabric.cloth.prescribe(
        v, mesh.positions.row(v) *
             (Eigen::Matrix3d::Identity() + part * (F - Eigen::Matrix3d::Identity())).transpose());
    fabric.cloth.step(0.01);
  }
  EXPECT_LT((fabric.cloth.positions() - mesh.positions * F.transpose()).cwiseAbs().maxCoeff(),
            1e-7);
}

TEST(exact_cloth, a_state_that_is_set_again_goes_on_as_before)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  const auto run               = [&](const bool interrupted)
  {
    auto fabric = std::make_unique<Fabric>(mesh, std::vector<int>{0}, ClothOptions(),
                                           isotropic(100., 0.2), 0.01);
    fabric->cloth.add(gravity_term(fabric->masses, earth));
    for (int k = 0; k < 30; ++k)
    {
      if (interrupted && k == 13)
      {
        auto other = std::make_unique<Fabric>(mesh, std::vector<int>{0}, ClothOptions(),
                                              isotropic(100., 0.2), 0.01);
        other->cloth.add(gravity_term(other->masses, earth));
        other->cloth.set_state(fabric->cloth.positions(), fabric->cloth.velocities(),
                               fabric->cloth.time());
        fabric = std::move(other);
      }
      fabric->cloth.step(0.01);
    }
    return fabric->cloth.positions();
  };
  EXPECT_EQ((run(false) - run(true)).cwiseAbs().maxCoeff(), 0.);
}

TEST(derivative_cloth, gradient_and_hessian_of_the_viscous_membrane_by_taylor_remainders)
{
  const meshes::ClothMesh mesh = lying_sheet(3);
  const auto term              = membrane_term(mesh, {anisotropic()}, 0.02);
  std::mt19937 generator(5);
  const int n     = mesh.n_vertices();
  const Vectors x = mesh.positions + 0.01 * random_matrix<Vectors>(generator, n, 3),
                d = 0.02 * random_matrix<Vectors>(generator, n, 3), zero = Vectors::Zero(n, 3);
  term->begin_step({mesh.positions, zero, 0., 0.01});
  std::vector<std::array<int, 2>> pairs;
  term->couple(pairs);
  BlockMatrix matrix(pairs, std::vector<bool>(static_cast<std::size_t>(n), false));
  term->attach(matrix);
  Vectors gradient = zero, product, alone = zero;
  term->add_derivatives(x, Hessian::exact, gradient, matrix);
  term->add_gradient(x, alone);
  EXPECT_LT((gradient - alone).norm(), 1e-13 * gradient.norm());
  matrix.multiply(d, product);
  const double value = term->energy(x), first = gradient.cwiseProduct(d).sum(),
               second = product.cwiseProduct(d).sum();
  std::vector<double> steps, without, with;
  for (double h = 1. / 16.; h > 1e-3; h *= 0.5)
  {
    const double rest = term->energy(x + h * d) - value - h * first;
    steps.push_back(h);
    without.push_back(std::abs(rest));
    with.push_back(std::abs(rest - 0.5 * h * h * second));
  }
  EXPECT_NEAR(slope(steps, without), 2., 0.1);
  EXPECT_NEAR(slope(steps, with), 3., 0.1);
}

TEST(bound_cloth, violent_starts_end_finite)
{
  const int n                  = 6;
  const meshes::ClothMesh mesh = lying_sheet(n);
  std::mt19937 generator(9);
  std::vector<Vectors> starts = {
    0.2 * random_matrix<Vectors>(generator, mesh.n_vertices(), 3),
    mesh.positions * Eigen::Vector3d(1., 0., 0.).asDiagonal(),
    mesh.positions * 0.,
    mesh.positions * Eigen::Vector3d(-1., 1., 1.).asDiagonal(),
  };
  starts.push_back(mesh.positions);
  starts.back().row(17) << 1e6, 0., 0.;
  for (const double h : {1e-5, 1e-2, 1.})
    for (std::size_t s = 0; s < starts.size(); ++s)
    {
      Fabric fabric(mesh, {0, n}, {}, anisotropic(), 1e-3);
      Vectors start = starts[s];
      start.row(0)  = mesh.positions.row(0);
      start.row(n)  = mesh.positions.row(n);
      fabric.cloth.set_state(start, Vectors::Zero(start.rows(), 3), 0.);
      fabric.cloth.add(gravity_term(fabric.masses, earth));
      double most = fabric.cloth.stored_energy();
      for (int k = 0; k < 20; ++k)
        ASSERT_NO_THROW(fabric.cloth.step(h)) << "start " << s << ", h " << h << ", step " << k;
      EXPECT_TRUE(fabric.cloth.positions().allFinite());
      EXPECT_LE(fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy(),
                most + 1e-6 * std::abs(most) + 1e-3)
        << "start " << s << ", h " << h;
    }
}

TEST(invariant_cloth, warped_nodes_of_a_bent_sheet_do_not_know_the_order_of_its_triangles)
{
  meshes::ClothMesh mesh = lying_sheet(3);
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
  {
    const double x = mesh.positions(v, 0), y = mesh.positions(v, 1);
    mesh.positions.row(v) << 1.05 * x, y + 0.2 * x * y, x * x - 2. * x * y;
  }
  const auto stepped = [](const meshes::ClothMesh &cloth_mesh)
  {
    const Eigen::VectorXd masses = lumped_masses(cloth_mesh, {0.2});
    Cloth cloth(cloth_mesh.positions, masses, {});
    cloth.add(nodal_warping_term(cloth_mesh, {isotropic(100., 0.3)}, masses));
    for (int k = 0; k < 3; ++k)
      cloth.step(0.01);
    return cloth.positions();
  };
  meshes::ClothMesh turned = mesh;
  turned.rest.triangles    = mesh.rest.triangles.colwise().reverse().eval();
  turned.triangles         = mesh.triangles.colwise().reverse().eval();
  EXPECT_GT((stepped(mesh) - mesh.positions).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((stepped(turned) - stepped(mesh)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(bound_cloth, bad_input_is_refused_by_name)
{
  const meshes::ClothMesh mesh = lying_sheet(3);
  Fabric fabric(mesh, {1});
  EXPECT_NE(refusal([&] { fabric.cloth.step(0.); }).find("expected a positive number"),
            std::string::npos);
  EXPECT_NE(refusal(
              [&] {
                fabric.cloth.prescribe(2, {0., 0., 0.});
              })
              .find("vertex 2"),
            std::string::npos);
  EXPECT_NE(refusal([&] { Fabric(mesh, {99}); }).find("held vertex 99"), std::string::npos);
  Vectors x = mesh.positions;
  x(5, 1)   = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal([&] { Cloth(x, fabric.masses, {}); }).find("vertex 5"), std::string::npos);
  EXPECT_NE(refusal([&] { lumped_masses(mesh, {-1.}); }).find("areal density of phase 0"),
            std::string::npos);
  EXPECT_NE(refusal([&] { membrane_term(mesh, {anisotropic()}, -1.); }).find("viscosity"),
            std::string::npos);
}
