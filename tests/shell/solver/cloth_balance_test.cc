// SPDX-License-Identifier: MIT
// What a cloth must keep: forces without sum and torque; and of momenta and energy what the theory
// of each integrator promises.
#include "shell/terms/bending.h"
#include "shell/terms/warping.h"
#include "tests/shell/solver/cloth_cases.h"
#include "tests/shell/terms/term_cases.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::shell;
using namespace homespun::tests;

namespace
{
/// Random velocities with momentum and spin.
Vectors some_velocities(const int n, const double size, const unsigned int seed)
{
  std::mt19937 generator(seed);
  return size * random_matrix<Vectors>(generator, n, 3);
}

Vectors spinning(const Vectors &positions, const Eigen::VectorXd &masses,
                 const Eigen::RowVector3d &omega)
{
  const Eigen::RowVector3d centre = masses.transpose() * positions / masses.sum();
  Vectors v(positions.rows(), 3);
  for (Eigen::Index i = 0; i < v.rows(); ++i)
    v.row(i) = omega.cross(positions.row(i) - centre);
  return v;
}

/// Two states of a sheet that lie apart by random displacements, and displacements of zero.
struct CrumpledStates
{
  Vectors before, x, zero;
};

CrumpledStates two_crumpled_states(const meshes::ClothMesh &mesh, std::mt19937 &generator)
{
  const int n          = mesh.n_vertices();
  const Vectors before = mesh.positions + 0.01 * random_matrix<Vectors>(generator, n, 3);
  return {before, before + 0.01 * random_matrix<Vectors>(generator, n, 3), Vectors::Zero(n, 3)};
}
} // namespace

TEST(invariant_cloth, any_rigid_motion_has_no_force)
{
  const meshes::ClothMesh mesh = lying_sheet(8);
  Fabric fabric(mesh);
  for (const double angle : {1e-9, 0.4, 2., 3.1415926535897931, 5.})
  {
    const Vectors x =
      (mesh.positions * rotation<3>(angle).transpose()).rowwise() + Eigen::RowVector3d(3., -2., 7.);
    fabric.cloth.set_state(x, Vectors::Zero(x.rows(), 3), 0.);
    // Seven metres from the origin a position has lost two digits against the edges.
    EXPECT_LT(fabric.cloth.gradient().cwiseAbs().maxCoeff(), 1e-13 * anisotropic().norm()) << angle;
  }
}

TEST(invariant_cloth, forces_of_membrane_viscosity_and_bending_sum_to_zero_and_have_no_torque)
{
  const meshes::ClothMesh mesh = lying_sheet(8);
  std::mt19937 generator(3);
  const auto [before, x, zero] = two_crumpled_states(mesh, generator);
  std::vector<std::unique_ptr<Term>> terms;
  terms.push_back(membrane_term(mesh, {anisotropic()}));
  terms.push_back(membrane_term(mesh, {anisotropic()}, 0.01));
  terms.push_back(viscosity_term(mesh, {anisotropic()}, 0.01));
  terms.push_back(bending_term(mesh, {PlateStiffness::isotropic(1e-4, 0.3)}));
  for (const auto &term : terms)
  {
    ASSERT_TRUE(term->is_internal());
    term->begin_step({before, zero, 0., 0.005});
    const Vectors f   = gradient_of(*term, x);
    const double size = f.rowwise().norm().sum();
    EXPECT_GT(size, 0.) << term->name();
    EXPECT_LT(f.colwise().sum().norm(), 1e-13 * size) << term->name();
    EXPECT_LT(torque(x, f).norm(), 1e-13 * size) << term->name();
  }
}

TEST(exact_cloth, viscosity_alone_is_what_it_adds_to_the_membrane)
{
  const meshes::ClothMesh mesh = lying_sheet(5);
  std::mt19937 generator(4);
  const auto [before, x, zero] = two_crumpled_states(mesh, generator);
  const auto elastic           = membrane_term(mesh, {anisotropic()}),
             both              = membrane_term(mesh, {anisotropic()}, 0.02),
             alone             = viscosity_term(mesh, {anisotropic()}, 0.02);
  EXPECT_EQ(gradient_of(*alone, x).norm(), 0.) << "before the first step";
  for (Term *const term : {elastic.get(), both.get(), alone.get()})
    term->begin_step({before, zero, 0., 0.005});
  const Vectors expected = gradient_of(*both, x) - gradient_of(*elastic, x);
  EXPECT_LT((gradient_of(*alone, x) - expected).norm(), 1e-13 * gradient_of(*both, x).norm());
  EXPECT_EQ(alone->stored_energy(x), 0.);
  const TaylorOrders orders =
    taylor_orders(*alone, x, 0.02 * random_matrix<Vectors>(generator, mesh.n_vertices(), 3));
  EXPECT_NEAR(orders.gradient, 2., 0.1);
  EXPECT_NEAR(orders.hessian, 3., 0.1);
  // At rest nothing is viscous: the strain is where it began.
  EXPECT_LT(gradient_of(*alone, before).norm(), 1e-13 * expected.norm());
}

TEST(order_cloth, conserving_viscosity_is_the_implicit_one_but_for_the_square_of_the_change)
{
  const meshes::ClothMesh mesh = lying_sheet(5);
  std::mt19937 generator(8);
  const int n          = mesh.n_vertices();
  const Vectors before = mesh.positions + 0.01 * random_matrix<Vectors>(generator, n, 3),
                change = random_matrix<Vectors>(generator, n, 3);
  const auto term      = viscosity_term(mesh, {anisotropic()}, 0.01);
  term->begin_step({before, before, 0., 0.005});
  const auto difference = [&](const double size)
  {
    const Vectors after    = before + size * change;
    const Vectors implicit = gradient_of(*term, after);
    return (discrete_gradient(*term, before, after) - implicit).norm() / implicit.norm();
  };
  EXPECT_NEAR(std::log2(difference(2e-5) / difference(1e-5)), 1., 0.1);
}

namespace
{
/// Sheets that spin and fly. The second one is a weave: its weak shear lets the spin become
/// stretch; in a step of 20 ms it turns by a fifth of a radian.
struct Flight
{
  Eigen::Matrix3d D;
  double h, velocity; ///< time step [s], size of random velocities [m/s]
};

std::vector<Flight> flights()
{
  Eigen::Matrix3d weave;
  weave << 47000., 2000., 0., 2000., 47000., 0., 0., 0., 81.;
  return {{anisotropic(), 5e-3, 0.}, {weave, 1e-3, 0.1}, {weave, 2e-2, 0.1}};
}

Fabric flying(const meshes::ClothMesh &mesh, const Flight &flight, const Integrator integrator)
{
  ClothOptions options;
  options.integrator = integrator;
  Fabric fabric(mesh, {}, options, flight.D, 1e-3);
  Vectors v = spinning(mesh.positions, fabric.masses, {3., -2., 10.}) +
              some_velocities(mesh.n_vertices(), flight.velocity, 1);
  v.rowwise() += Eigen::RowVector3d(0.3, 0.1, -0.2);
  fabric.cloth.set_state(mesh.positions, v, 0.);
  return fabric;
}
} // namespace

TEST(invariant_cloth, a_free_sheet_keeps_the_momenta_that_its_integrator_keeps_and_gains_no_energy)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  for (const Flight &flight : flights())
    for (const Integrator integrator :
         {Integrator::linearly_implicit, Integrator::implicit, Integrator::conserving})
    {
      Fabric fabric              = flying(mesh, flight, integrator);
      const Eigen::RowVector3d p = fabric.cloth.momentum(), L = fabric.cloth.angular_momentum();
      double energy = fabric.cloth.kinetic_energy();
      for (int k = 0; k < 100; ++k)
      {
        const Vectors x = fabric.cloth.positions();
        fabric.cloth.step(flight.h);
        const Vectors seen = (fabric.cloth.positions() - x) / flight.h;
        EXPECT_LT((fabric.masses.transpose() * seen - p).norm(), 1e-11 * p.norm()) << flight.h;
        const double after = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
        ASSERT_LE(after / energy - 1., 1e-11) << flight.h << ", step " << k;
        energy = after;
      }
      EXPECT_LT((fabric.cloth.momentum() - p).norm(), 1e-11 * p.norm()) << flight.h;
      if (integrator == Integrator::conserving)
      {
        EXPECT_LT((fabric.cloth.angular_momentum() - L).norm(), 1e-11 * L.norm()) << flight.h;
      }
    }
}

namespace
{
/// How far the angular momentum that a step loses is from what implicit Euler itself loses: with v
/// = (x_{n+1} − x_n)/h and internal forces without torque, L_{n+1} = L_n − h Σ m v_n × v_{n+1}.
/// Largest over the steps, relative to L.
double unexplained_spin(Cloth &cloth, const double h, const int n_steps)
{
  const double L = cloth.angular_momentum().norm();
  double worst   = 0.;
  for (int k = 0; k < n_steps; ++k)
  {
    const Vectors v               = cloth.velocities();
    const Eigen::RowVector3d spin = cloth.angular_momentum();
    const StepReport report       = cloth.step(h);
    const Eigen::RowVector3d mean = cloth.momentum() / cloth.masses().sum();
    Eigen::RowVector3d change     = cloth.angular_momentum() - spin;
    EXPECT_NEAR(report.spin_lost, change.norm(), 1e-12 * L);
    for (Eigen::Index i = 0; i < v.rows(); ++i)
      change += h * cloth.masses()(i) * (v.row(i) - mean).cross(cloth.velocities().row(i) - mean);
    worst = std::max(worst, change.norm() / L);
  }
  return worst;
}
} // namespace

TEST(exact_cloth, the_spin_that_implicit_euler_loses_is_that_of_its_theory_and_nothing_else)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  const Eigen::Matrix3d D      = isotropic(1000., 0.3);
  ClothOptions options;
  options.integrator       = Integrator::implicit;
  options.newton_tolerance = 1e-10;
  for (const double h : {0.01, 0.005, 0.0025})
  {
    Fabric exact(mesh, {}, options, D, 1e-3);
    Cloth warped(mesh.positions, exact.masses, {}, options);
    warped.add(nodal_warping_term(mesh, {D}, exact.masses));
    for (Cloth *const cloth : {&exact.cloth, &warped})
      cloth->set_state(mesh.positions, spinning(mesh.positions, exact.masses, {3., -2., 10.}), 0.);
    EXPECT_LT(unexplained_spin(exact.cloth, h, 40), 1e-10) << h;
    // A rotation that is frozen over the step leaves a torque: this is what would be noticed.
    EXPECT_GT(unexplained_spin(warped, h, 40), 1e-4) << h;
  }
}

TEST(exact_cloth, the_energy_of_implicit_euler_changes_as_its_theory_says)
{
  // −½ Σ m |v_{n+1} − v_n|² + E(x_{n+1}) − E(x_n) − dE(x_{n+1})·(x_{n+1} − x_n), which may have any
  // sign.
  const meshes::ClothMesh mesh = lying_sheet(6);
  ClothOptions options;
  options.integrator       = Integrator::implicit;
  options.newton_tolerance = 1e-10;
  Fabric fabric(mesh, {0}, options, anisotropic());
  Cloth &cloth = fabric.cloth;
  Vectors v    = some_velocities(mesh.n_vertices(), 1., 3);
  v.row(0).setZero();
  cloth.set_state(mesh.positions, v, 0.);
  for (int k = 0; k < 40; ++k)
  {
    const Vectors old_x = cloth.positions(), old_v = cloth.velocities();
    const double kinetic = cloth.kinetic_energy(), stored = cloth.stored_energy();
    const StepReport report = cloth.step(2e-3);
    ASSERT_EQ(report.cuts, 0);
    Vectors gradient = cloth.gradient();
    gradient.row(0).setZero();
    const double change = cloth.kinetic_energy() - kinetic + cloth.stored_energy() - stored,
                 expected =
                   cloth.stored_energy() - stored -
                   gradient.cwiseProduct(cloth.positions() - old_x).sum() -
                   0.5 * fabric.masses.dot((cloth.velocities() - old_v).rowwise().squaredNorm());
    EXPECT_NEAR(change, expected, 1e-9 * (kinetic + stored)) << k;
    EXPECT_NEAR(report.energy_gained, std::max(0., change), 1e-12 * (kinetic + stored)) << k;
  }
}

TEST(invariant_cloth, all_vertices_of_a_handle_may_pull_and_a_step_is_judged_in_their_frame)
{
  // One edge is suddenly pulled. In its frame nothing does work: no step raises the energy there.
  const int n                  = 6;
  const meshes::ClothMesh mesh = lying_sheet(n);
  std::vector<int> held;
  for (int i = 0; i <= n; ++i)
    held.push_back(i);
  const Eigen::RowVector3d velocity(0., -5., 0.);
  for (const Integrator integrator : {Integrator::linearly_implicit, Integrator::implicit})
    for (const double h : {1e-3, 1e-2, 2e-2, 5e-2})
    {
      ClothOptions options;
      options.integrator = integrator;
      Fabric fabric(mesh, held, options, anisotropic(), 1e-3);
      Cloth &cloth           = fabric.cloth;
      const auto energy_seen = [&]()
      {
        const Vectors relative = cloth.velocities().rowwise() - velocity;
        return cloth.stored_energy() + 0.5 * fabric.masses.dot(relative.rowwise().squaredNorm());
      };
      double before = energy_seen();
      int guarded   = 0;
      for (int k = 1; k <= 50; ++k)
      {
        for (const int v : held)
          cloth.prescribe(v, mesh.positions.row(v) + k * h * velocity);
        guarded += cloth.step(h).guarded;
        EXPECT_LE(energy_seen(), before * (1. + 1e-11)) << h << ", " << k;
        before = energy_seen();
      }
      if (integrator == Integrator::linearly_implicit && h == 2e-2)
      {
        EXPECT_GT(guarded, 0) << "one Newton step alone raises it";
      }
    }
}

TEST(invariant_cloth, momenta_lost_to_the_air_are_those_of_the_damping)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  Fabric fabric(mesh);
  const double rate = 2., h = 0.01;
  fabric.cloth.add(mass_damping_term(fabric.masses, rate));
  Vectors v = Vectors::Zero(mesh.n_vertices(), 3);
  v.rowwise() += Eigen::RowVector3d(0.3, 0.1, -0.2);
  fabric.cloth.set_state(mesh.positions, v, 0.);
  for (int k = 0; k < 50; ++k)
    fabric.cloth.step(h);
  const double left = std::pow(1. + rate * h, -50);
  EXPECT_LT((fabric.cloth.velocities() - left * v).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(bound_cloth, energy_never_grows_with_damping_on)
{
  for (const double h : {1e-4, 1e-3, 1e-2, 5e-2})
    for (const std::vector<int> &held : {std::vector<int>{0, 8}, std::vector<int>{}})
    {
      const meshes::ClothMesh mesh = lying_sheet(8);
      Fabric fabric(mesh, held, {}, isotropic(1000., 0.3), 1e-3);
      fabric.cloth.add(mass_damping_term(fabric.masses, 0.5));
      fabric.cloth.set_state(mesh.positions, some_velocities(mesh.n_vertices(), 0.5, 11), 0.);
      double energy = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
      for (int k = 0; k < 100; ++k)
      {
        fabric.cloth.step(h);
        const double next = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
        ASSERT_LE(next, energy * (1. + 1e-12))
          << "h " << h << ", step " << k << (held.empty() ? ", free" : ", held");
        energy = next;
      }
    }
}
