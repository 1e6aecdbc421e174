// SPDX-License-Identifier: MIT
// What a cloth must keep: forces without sum and torque, both momenta, the energy; and how much of that a step had to
// put right.
#include "shell/bending.h"
#include "shell/warping.h"
#include "tests/shell/cloth_cases.h"
#include "tests/shell/term_cases.h"

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

TEST(invariant_cloth, a_spinning_free_sheet_keeps_its_momenta)
{
  // The second one is a weave: it turns by a fifth of a radian in a step of 20 ms and its weak shear lets most of the spin
  // become stretch, which putting the spin right would pay twice.
  Eigen::Matrix3d weave;
  weave << 47000., 2000., 0., 2000., 47000., 0., 0., 0., 81.;
  struct Sheet
  {
    Eigen::Matrix3d D;
    double h, velocity; ///< time step [s], size of random velocities [m/s]
  };
  for (const Sheet &sheet :
       {Sheet{anisotropic(), 5e-3, 0.}, Sheet{weave, 1e-3, 0.1}, Sheet{weave, 2e-2, 0.1}})
    for (const Integrator integrator : {Integrator::linearly_implicit, Integrator::implicit})
    {
      const meshes::ClothMesh mesh = lying_sheet(6);
      ClothOptions options;
      options.integrator = integrator;
      Fabric fabric(mesh, {}, options, sheet.D, 1e-3);
      Vectors v = spinning(mesh.positions, fabric.masses, {3., -2., 10.}) +
                  some_velocities(mesh.n_vertices(), sheet.velocity, 1);
      v.rowwise() += Eigen::RowVector3d(0.3, 0.1, -0.2);
      fabric.cloth.set_state(mesh.positions, v, 0.);
      const Eigen::RowVector3d p = fabric.cloth.momentum(), L = fabric.cloth.angular_momentum();
      double energy = fabric.cloth.kinetic_energy();
      for (int k = 0; k < 200; ++k)
      {
        fabric.cloth.step(sheet.h);
        const double after = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
        ASSERT_LE(after / energy - 1., 1e-11) << sheet.h << ", step " << k;
        energy = after;
      }
      EXPECT_LT((fabric.cloth.momentum() - p).norm(), 1e-11 * p.norm()) << sheet.h;
      EXPECT_LT((fabric.cloth.angular_momentum() - L).norm(), 1e-11 * L.norm()) << sheet.h;
    }
}

namespace
{
/// How far the spin that a step puts back is from what implicit Euler itself loses: with v = (x_{n+1} − x_n)/h and
/// internal forces without torque, L_{n+1} = L_n + h Σ m v × v_n. Largest over the steps, relative to L.
double unexplained_spin(Cloth &cloth, const double h, const int n_steps)
{
  const double L = cloth.angular_momentum().norm();
  double worst   = 0.;
  for (int k = 0; k < n_steps; ++k)
  {
    const Vectors x = cloth.positions(), v = cloth.velocities();
    const double restored         = cloth.step(h).spin_restored;
    const Vectors moved           = (cloth.positions() - x) / h;
    const Eigen::RowVector3d mean = cloth.momentum() / cloth.masses().sum();
    Eigen::RowVector3d lost       = Eigen::RowVector3d::Zero();
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      lost += h * cloth.masses()(i) * (moved.row(i) - mean).cross(v.row(i) - mean);
    worst = std::max(worst, std::abs(restored - lost.norm()) / L);
  }
  return worst;
}
} // namespace

TEST(exact_cloth, the_spin_that_is_put_back_is_what_implicit_euler_loses_and_nothing_else)
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
    warped.add(triangle_warping_term(mesh, {D}));
    for (Cloth *const cloth : {&exact.cloth, &warped})
      cloth->set_state(mesh.positions, spinning(mesh.positions, exact.masses, {3., -2., 10.}), 0.);
    EXPECT_LT(unexplained_spin(exact.cloth, h, 40), 1e-10) << h;
    // A rotation that is frozen over the step leaves a torque: this is what would be noticed.
    EXPECT_GT(unexplained_spin(warped, h, 40), 1e-4) << h;
  }
}

TEST(bound_cloth, a_step_of_any_integrator_puts_little_of_the_spin_back)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  const double omega           = 10.;
  for (const Integrator integrator : {Integrator::linearly_implicit, Integrator::implicit})
    for (const double h : {0.01, 0.005, 0.0025, 0.00125, 0.000625})
    {
      ClothOptions options;
      options.integrator = integrator;
      Fabric fabric(mesh, {}, options, isotropic(1000., 0.3), 1e-3);
      fabric.cloth.set_state(mesh.positions,
                             spinning(mesh.positions, fabric.masses, {0., 0., omega}), 0.);
      const double L = fabric.cloth.angular_momentum().norm();
      // Implicit Euler loses (omega h)² of it; one Newton step, whose rotation is a straight motion, more where sound
      // does not cross the sheet in a step.
      for (int k = 0; k < static_cast<int>(std::lround(0.2 / h)); ++k)
        ASSERT_LT(fabric.cloth.step(h).spin_restored, 0.01 * L) << h << ", step " << k;
    }
}

TEST(bound_cloth, a_spinning_sheet_keeps_its_energy_over_a_turn)
{
  // Of a rigid body with its angular momentum kept, all of it: L²/(2 I). What goes is the first swing of the stretch
  // by the spin, whose strain is some rho (omega r)²/E = 4e-4.
  const meshes::ClothMesh mesh = lying_sheet(6);
  const double omega = 10., pi = std::acos(-1.);
  for (const double h : {0.01, 0.0025})
  {
    Fabric fabric(mesh, {}, {}, isotropic(1000., 0.3), 1e-3);
    fabric.cloth.set_state(mesh.positions, spinning(mesh.positions, fabric.masses, {0., 0., omega}),
                           0.);
    const double before = fabric.cloth.kinetic_energy();
    // What the restored spin brings in, with the motion outwards of each step, goes again: (omega h)² at most.
    for (int k = 0; k < static_cast<int>(std::lround(2. * pi / omega / h)); ++k)
      ASSERT_LT(fabric.cloth.step(h).energy_removed, omega * omega * h * h * before) << k;
    const double after = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
    EXPECT_GT(after, 0.99 * before) << h;
    EXPECT_LE(after, before * (1. + 1e-12)) << h;
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

TEST(invariant_cloth, the_air_takes_its_part_of_a_spin_and_gives_none)
{
  // L_{n+1} = L_n / (1 + h alpha), however much spin the linearization has to be given back.
  const meshes::ClothMesh mesh = lying_sheet(6);
  const double rate = 2., h = 0.01;
  for (const double turn : {0., 30.})
  {
    Fabric fabric(mesh);
    fabric.cloth.add(mass_damping_term(fabric.masses, rate));
    Vectors x = mesh.positions;
    x.row(5) += Eigen::RowVector3d(0.3, -0.2, 0.1); // far from equilibrium
    fabric.cloth.set_state(x, spinning(x, fabric.masses, Eigen::RowVector3d(0.3, 0.1, 1.) * turn),
                           0.);
    const Eigen::RowVector3d L = fabric.cloth.angular_momentum();
    // The spin that the stored energy could drive: what is left of none must be small against it.
    const double size = std::sqrt(fabric.cloth.stored_energy() * fabric.masses.sum()) * 0.3;
    for (int k = 0; k < 50; ++k)
      fabric.cloth.step(h);
    const Eigen::RowVector3d left = L * std::pow(1. + rate * h, -50);
    EXPECT_LT((fabric.cloth.angular_momentum() - left).norm(), 1e-12 * std::max(L.norm(), size));
  }
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
      double energy = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy(), removed = 0.;
      const double at_first = energy;
      for (int k = 0; k < 100; ++k)
      {
        removed += fabric.cloth.step(h).energy_removed;
        const double next = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
        ASSERT_LE(next, energy * (1. + 1e-12))
          << "h " << h << ", step " << k << (held.empty() ? ", free" : ", held");
        energy = next;
      }
      // The integrator itself does not let it grow: nothing is left for the last resort.
      EXPECT_LT(removed, 1e-6 * at_first) << "h " << h << (held.empty() ? ", free" : ", held");
    }
}
