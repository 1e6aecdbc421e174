// SPDX-License-Identifier: MIT
// Moving triangles of six nodes: their derivatives, masses, balances, waves and orders.
#include "meshes/plain/sheet.h"
#include "shell/solver/cloth.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/six_node_term.h"
#include "tests/refusal.h"
#include "tests/shell/terms/term_cases.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::shell;
using namespace homespun::tests;

namespace
{
meshes::TriangleMesh grid(const int n, const double side = 0.2)
{
  Eigen::Matrix2d steps;
  steps << side, 0., 0.3 * side, side;
  meshes::TriangleMesh mesh = meshes::coarse_sheet({0., 0.}, steps / n, n, n);
  mesh.material             = Eigen::VectorXi::Zero(mesh.n_triangles());
  return mesh;
}

SixNodeMesh six_nodes(const meshes::TriangleMesh &mesh, const int n)
{
  return six_node_mesh(mesh, n, n);
}

struct SixNodeFabric
{
  explicit SixNodeFabric(const meshes::TriangleMesh &mesh, const int n,
                         const std::vector<int> &held = {}, const ClothOptions &options = {},
                         const Eigen::Matrix3d &stiffness = isotropic(1000., 0.3))
      : masses(six_node_masses(six_nodes(mesh, n), 0.2))
      , cloth(embedded<3>(mesh), masses, held, options)
  {
    cloth.add(six_node_term(six_nodes(mesh, n), stiffness));
  }
  Eigen::VectorXd masses;
  Cloth cloth;
};

meshes::CubicForm some_cubic()
{
  meshes::CubicForm form;
  form.derivatives << 300., -150., 90., 240., -60., 450., 360., 120., -300., 180.;
  return form;
}
} // namespace

TEST(derivative_six_node_term, taylor_remainders_are_of_second_and_third_order)
{
  const int n                     = 4;
  const meshes::TriangleMesh mesh = grid(n);
  std::mt19937 generator(3);
  for (const bool with_more : {false, true})
  {
    const auto term =
      with_more ? six_node_term(six_nodes(mesh, n), isotropic(1000., 0.3), 0.02, {some_cubic()})
                : six_node_term(six_nodes(mesh, n), anisotropic());
    const auto some = [&](const double size)
    { return Vectors(size * random_matrix<Vectors>(generator, mesh.n_vertices(), 3)); };
    const Vectors x = 1.1 * embedded<3>(mesh) + some(3e-3), old = 1.05 * embedded<3>(mesh);
    term->begin_step({old, old, 0., 0.01});
    const TaylorOrders orders = taylor_orders(*term, x, some(5e-3));
    EXPECT_NEAR(orders.gradient, 2., 0.1) << with_more;
    EXPECT_NEAR(orders.hessian, 3., 0.15) << with_more;
    // Forces alone, and those that come with the stiffness.
    BlockMatrix matrix = matrix_for(*term, mesh.n_vertices());
    Vectors together   = Vectors::Zero(x.rows(), 3);
    term->add_derivatives(x, Hessian::projected, together, matrix);
    EXPECT_LT((together - gradient_of(*term, x)).norm(), 1e-11 * together.norm());
    EXPECT_GT(smallest_eigenvalue_ratio(matrix), -1e-12);
  }
}

TEST(invariant_six_node_term, forces_sum_to_zero_and_have_no_torque_and_rigid_motions_have_none)
{
  const int n                     = 4;
  const meshes::TriangleMesh mesh = grid(n);
  const auto term = six_node_term(six_nodes(mesh, n), anisotropic(), 0., {some_cubic()});
  std::mt19937 generator(4);
  for (const double angle : {0.4, 2., 5.})
  {
    Vectors x = embedded<3>(mesh) * rotation<3>(angle).transpose();
    EXPECT_LT(gradient_of(*term, x).cwiseAbs().maxCoeff(), 1e-12 * anisotropic().norm());
    x += 0.01 * random_matrix<Vectors>(generator, x.rows(), 3);
    const Vectors forces = gradient_of(*term, x);
    EXPECT_LT(forces.colwise().sum().norm(), 1e-12 * forces.norm());
    EXPECT_LT(torque(x, forces).norm(), 1e-12 * forces.norm());
  }
}

// In its plane it is the membrane of six_node_membrane.h.
TEST(exact_six_node_term, energy_and_forces_are_those_of_the_sheet_in_its_plane)
{
  const int n                     = 4;
  const meshes::TriangleMesh mesh = grid(n);
  const auto term                 = six_node_term(six_nodes(mesh, n), anisotropic());
  const SixNodeMembrane flat      = six_node_membrane(six_nodes(mesh, n), anisotropic());
  std::mt19937 generator(5);
  Positions<2> x = 1.1 * mesh.vertices;
  x += 2e-3 * random_matrix<Positions<2>>(generator, mesh.n_vertices(), 2);
  Vectors in_space       = Vectors::Zero(mesh.n_vertices(), 3);
  in_space.leftCols<2>() = x;
  const double energy    = membrane_energy<2>(flat, x);
  EXPECT_NEAR(term->energy(in_space), energy, 1e-12 * energy);
  const Positions<2> forces = membrane_gradient<2>(flat, x).gradient;
  EXPECT_LT((gradient_of(*term, in_space).leftCols<2>() - forces).norm(), 1e-11 * forces.norm());
}

TEST(exact_six_node_masses, mass_and_centre_of_mass_are_those_of_the_sheet)
{
  const int n                     = 6;
  const meshes::TriangleMesh mesh = grid(n);
  const Eigen::VectorXd masses    = six_node_masses(six_nodes(mesh, n), 0.2);
  EXPECT_GT(masses.minCoeff(), 0.);
  EXPECT_NEAR(masses.sum(), 0.2 * 0.2 * 0.2, 1e-15);
  const Eigen::RowVector2d centre = masses.transpose() * mesh.vertices / masses.sum(),
                           middle = 0.5 * (mesh.vertices.row(0) +
                                           mesh.vertices.row(mesh.n_vertices() - 1));
  EXPECT_LT((centre - middle).norm(), 1e-14);
  const std::string text = refusal([&]() { six_node_masses(six_nodes(mesh, n), 0.); });
  EXPECT_NE(text.find("areal density: found 0.000000 kg/m^2"), std::string::npos) << text;
}

// A free sheet that stretches, turns and flies. Implicit Euler keeps the linear momentum to
// round-off and loses of the angular one what its theory says, h sum m v_n x v_(n+1).
TEST(invariant_six_node_term, a_free_sheet_keeps_its_momentum_and_loses_the_spin_of_theory)
{
  const int n                     = 6;
  const meshes::TriangleMesh mesh = grid(n);
  for (const Integrator integrator : {Integrator::linearly_implicit, Integrator::implicit})
  {
    ClothOptions options;
    options.integrator = integrator;
    SixNodeFabric fabric(mesh, n, {}, options);
    Vectors x = embedded<3>(mesh), v = x;
    for (Eigen::Index k = 0; k < x.rows(); ++k)
    {
      v.row(k) << 0.3 + 2. * x(k, 0) - 5. * x(k, 1), 5. * x(k, 0) - x(k, 1), 1. + 3. * x(k, 1);
      x(k, 0) *= 1.05;
    }
    fabric.cloth.set_state(x, v, 0.);
    const Eigen::RowVector3d momentum = fabric.cloth.momentum();
    const double moved                = fabric.masses.dot(v.rowwise().norm());
    for (int k = 0; k < 50; ++k)
    {
      const Vectors before           = fabric.cloth.velocities();
      const Eigen::RowVector3d spin  = fabric.cloth.angular_momentum();
      constexpr double h             = 2e-3;
      const StepReport report        = fabric.cloth.step(h);
      Eigen::RowVector3d lost        = Eigen::RowVector3d::Zero();
      const Vectors after            = fabric.cloth.velocities();
      const Eigen::RowVector3d drift = momentum / fabric.masses.sum();
      for (Eigen::Index i = 0; i < after.rows(); ++i)
        lost +=
          h * fabric.masses(i) *
          Eigen::RowVector3d(before.row(i) - drift).cross(Eigen::RowVector3d(after.row(i) - drift));
      EXPECT_LT((fabric.cloth.momentum() - momentum).norm(), 1e-11 * moved) << k;
      if (integrator == Integrator::implicit && report.cuts == 0)
      {
        EXPECT_LT((spin - fabric.cloth.angular_momentum() - lost).norm(),
                  1e-3 * lost.norm() + 1e-12)
          << k;
      }
    }
  }
}

// Against a tenth of the smallest step.
TEST(order_six_node_term, positions_are_of_first_order_in_the_time_step)
{
  const int n                     = 4;
  const meshes::TriangleMesh mesh = grid(n);
  std::vector<int> held;
  for (int i = 0; i <= n; ++i)
    held.push_back(i);
  const auto after = [&](const double h)
  {
    ClothOptions options;
    options.integrator = Integrator::implicit;
    SixNodeFabric fabric(mesh, n, held, options);
    Vectors x = embedded<3>(mesh);
    x.col(1) *= 1.05;
    fabric.cloth.set_state(x, Vectors::Zero(x.rows(), 3), 0.);
    for (int k = 0; k < std::lround(4e-3 / h); ++k)
      fabric.cloth.step(h);
    return fabric.cloth.positions();
  };
  const Vectors limit = after(2.5e-6);
  std::vector<double> steps, errors;
  for (const double h : {1e-4, 5e-5, 2.5e-5})
  {
    steps.push_back(h);
    errors.push_back((after(h) - limit).norm());
  }
  EXPECT_NEAR(slope(steps, errors), 1., 0.2);
}

TEST(exact_six_node_term, free_fall_is_straight)
{
  const int n                     = 4;
  const meshes::TriangleMesh mesh = grid(n);
  SixNodeFabric fabric(mesh, n);
  fabric.cloth.add(gravity_term(fabric.masses, {0., 0., -9.81}));
  constexpr double h = 0.01;
  for (int k = 0; k < 20; ++k)
    fabric.cloth.step(h);
  Vectors expected = embedded<3>(mesh);
  expected.col(2).array() -= 9.81 * h * h * 20. * 21. / 2.;
  EXPECT_LT((fabric.cloth.positions() - expected).cwiseAbs().maxCoeff(), 1e-12);
}
