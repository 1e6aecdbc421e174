// SPDX-License-Identifier: MIT
// The integrators on a motion that is known: a free sheet in its relative equilibrium turns by ω t
// without changing its shape. Isotropic; and with stiffnesses of 1e4 to 1.
#include "tests/shell/solver/relative_equilibrium.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace homespun;
using namespace homespun::shell;
using namespace homespun::tests;

namespace
{
struct Sheet
{
  const char *name;
  Eigen::Matrix3d D;
  double omega; ///< [rad/s], such that the sheet is stretched by 1e-4 to 1 %
};

std::vector<Sheet> sheets()
{
  return {{"isotropic, stiff", isotropic(1000., 0.3), 10.},
          {"isotropic, soft", isotropic(1000., 0.3), 100.},
          {"anisotropic 1e4", anisotropic(), 2.}};
}

const std::vector<std::pair<Integrator, const char *>> integrators = {
  {Integrator::linearly_implicit, "linearly implicit"},
  {Integrator::implicit, "implicit"},
  {Integrator::conserving, "conserving"}};

Vectors turned(const Vectors &x, const double angle)
{
  return x * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix().transpose();
}

/// Σ m (x0 × x1) and Σ m x0·x1: sine and cosine of the turn between two states, times the moment of
/// inertia.
Eigen::Vector2d turn_between(const Eigen::VectorXd &m, const Vectors &x0, const Vectors &x1)
{
  return {
    m.dot((x0.col(0).array() * x1.col(1).array() - x0.col(1).array() * x1.col(0).array()).matrix()),
    m.dot(x0.cwiseProduct(x1).rowwise().sum())};
}

/// What became of a sheet that started in its relative equilibrium.
struct Turning
{
  double error      = 0.; ///< in the positions at the end, over their size [-]
  double least_turn = HUGE_VAL, most_turn = 0.; ///< of a step, over what theory gives it
  double least_seen = HUGE_VAL; ///< share of L in the motion of a step, over what theory leaves
  double seen       = 0.;       ///< the share itself, of the first step
  double energy = 0., L = 0.;   ///< at the end, over that at the start
  double energy_gained = 0.;    ///< largest of a step, over that at the start
  int cuts = 0, guarded = 0;
};

/// @param angle h ω of a step [rad]
Turning turning(const Sheet &sheet, const Integrator integrator, const double angle,
                const int n_steps)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  ClothOptions options;
  options.integrator       = integrator;
  options.newton_tolerance = 1e-10;
  Fabric fabric(mesh, {}, options, sheet.D);
  Cloth &cloth                    = fabric.cloth;
  const Eigen::VectorXd &m        = fabric.masses;
  const RelativeEquilibrium start = relative_equilibrium(mesh, sheet.D, m, sheet.omega);
  cloth.set_state(start.positions, start.velocities, 0.);
  const double h = angle / sheet.omega, L = cloth.angular_momentum()(2),
               energy = cloth.kinetic_energy() + cloth.stored_energy();
  Turning result;
  for (int k = 0; k < n_steps; ++k)
  {
    const Vectors x = cloth.positions(), v = cloth.velocities();
    const double inertia = m.dot(x.rowwise().squaredNorm()), spin = cloth.angular_momentum()(2);
    // The midpoint rule turns a rigid body by 2 atan(h ω/2); implicit Euler to where x + h v
    // points.
    const double euler =
                   std::atan2(h * spin, inertia + h * m.dot(x.cwiseProduct(v).rowwise().sum())),
                 theory        = integrator == Integrator::conserving
                                   ? 2. * std::atan(0.5 * h * spin / inertia)
                                   : euler;
    const StepReport report    = cloth.step(h);
    const Eigen::Vector2d turn = turn_between(m, x, cloth.positions());
    // What theory leaves of a rigid body's angular momentum in its motion is sin of the turn over
    // the turn h ω.
    const double seen = turn(0) / h / spin, share = std::sin(theory) / (h * spin / inertia);
    if (k == 0)
      result.seen = seen;
    result.least_seen      = std::min(result.least_seen, seen / share);
    const double turned_by = std::atan2(turn(0), turn(1)) / theory;
    if (report.cuts == 0)
    {
      result.least_turn = std::min(result.least_turn, turned_by);
      result.most_turn  = std::max(result.most_turn, turned_by);
    }
    result.energy_gained = std::max(result.energy_gained, report.energy_gained / energy);
    result.cuts += report.cuts;
    result.guarded += report.guarded;
  }
  result.error =
    (cloth.positions() - turned(start.positions, n_steps * angle)).norm() / start.positions.norm();
  result.L      = cloth.angular_momentum()(2) / L;
  result.energy = (cloth.kinetic_energy() + cloth.stored_energy()) / energy;
  return result;
}
} // namespace

TEST(exact_integrators, the_conserving_one_turns_a_relative_equilibrium_as_it_is)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  for (const Sheet &sheet : sheets())
    for (const double angle : {0.1, 1., 3., 6.})
    {
      ClothOptions options;
      options.integrator       = Integrator::conserving;
      options.newton_tolerance = 1e-10;
      Fabric fabric(mesh, {}, options, sheet.D);
      const RelativeEquilibrium start =
        relative_equilibrium(mesh, sheet.D, fabric.masses, sheet.omega);
      // About an axis of its own: nothing in the scheme knows the plane.
      const Eigen::Matrix3d Q =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., 2.) / 3.).toRotationMatrix();
      fabric.cloth.set_state(start.positions * Q.transpose(), start.velocities * Q.transpose(), 0.);
      const double L      = fabric.cloth.angular_momentum().norm(),
                   energy = fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy();
      const int n_steps   = 10;
      for (int k = 0; k < n_steps; ++k)
        fabric.cloth.step(angle / sheet.omega);
      const Vectors expected =
        turned(start.positions, n_steps * 2. * std::atan(0.5 * angle)) * Q.transpose();
      EXPECT_LT((fabric.cloth.positions() - expected).norm(), 1e-8 * expected.norm())
        << sheet.name << ", " << angle;
      EXPECT_NEAR(fabric.cloth.angular_momentum().norm() / L, 1., 1e-12) << sheet.name;
      EXPECT_NEAR((fabric.cloth.kinetic_energy() + fabric.cloth.stored_energy()) / energy, 1.,
                  1e-12)
        << sheet.name;
    }
}

TEST(bound_integrators, no_step_turns_by_less_than_half_of_what_theory_gives)
{
  for (const Sheet &sheet : sheets())
    for (const auto &[integrator, name] : integrators)
      for (const double angle : {0.01, 0.1, 1., 3., 6.})
      {
        const Turning result = turning(sheet, integrator, angle, 40);
        EXPECT_GT(result.least_turn, 0.5) << sheet.name << ", " << name << ", " << angle;
        EXPECT_GT(result.least_seen, 0.5) << sheet.name << ", " << name << ", " << angle;
        EXPECT_LT(result.energy_gained, 1e-11) << sheet.name << ", " << name << ", " << angle;
        if (integrator == Integrator::conserving)
        {
          EXPECT_NEAR(result.L, 1., 1e-11) << sheet.name << ", " << angle;
          EXPECT_NEAR(result.energy, 1., 1e-11) << sheet.name << ", " << angle;
          EXPECT_NEAR(result.seen, 1. / (1. + 0.25 * angle * angle), 1e-9) << sheet.name;
        }
      }
}

TEST(exact_integrators, a_stiff_sheet_turns_as_theory_says_of_a_rigid_body)
{
  // Strains of 1e-4: what they change the turn by is of their order. One Newton step begins beside
  // that with the stretch by which x + h v is too far out, (h ω)²/2.
  for (const auto &[integrator, name] : integrators)
    for (const double angle : {0.01, 0.1, 0.3})
    {
      const Turning result = turning(sheets()[0], integrator, angle, 20);
      const double limit =
        1e-3 + (integrator == Integrator::linearly_implicit ? 0.5 * angle * angle : 0.);
      EXPECT_NEAR(result.least_turn, 1., limit) << name << ", " << angle;
      EXPECT_NEAR(result.most_turn, 1., limit) << name << ", " << angle;
    }
  const double angle = 0.1;
  EXPECT_NEAR(turning(sheets()[0], Integrator::implicit, angle, 1).L,
              1. / std::sqrt(1. + angle * angle), 1e-4);
}

TEST(order_integrators, positions_are_of_first_order_and_of_second_where_momenta_are_kept)
{
  constexpr double whole = 1.6; // [rad]
  for (const Sheet &sheet : sheets())
    for (const auto &[integrator, name] : integrators)
    {
      std::vector<double> steps, errors;
      for (const int n_steps : {32, 64, 128, 256})
      {
        steps.push_back(whole / n_steps);
        errors.push_back(turning(sheet, integrator, whole / n_steps, n_steps).error);
      }
      EXPECT_NEAR(slope(steps, errors), integrator == Integrator::conserving ? 2. : 1., 0.1)
        << sheet.name << ", " << name;
    }
}

// A table, not a test: shell/test --gtest_also_run_disabled_tests --gtest_filter=*figures*
TEST(order_integrators, DISABLED_figures)
{
  for (const Sheet &sheet : sheets())
    for (const auto &[integrator, name] : integrators)
      for (const double angle : {0.00625, 0.0125, 0.025, 0.05, 0.1, 0.3, 1., 3., 6.})
      {
        const int n_steps    = static_cast<int>(std::lround(std::max(1.6 / angle, 50.)));
        const Turning result = turning(sheet, integrator, angle, n_steps);
        std::printf("%s | %s | %g | %d | %.2e | %.4f | %.4f | %.3g | %.9f | %.3g | %d | %d\n",
                    sheet.name, name, angle, n_steps, result.error, result.seen, result.least_turn,
                    result.L, result.energy, result.energy_gained, result.guarded, result.cuts);
      }
}
