// SPDX-License-Identifier: MIT
#include "verification/stress/stress_sheet_axes.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/symmetric_eigen.h"
#include "shell/solver/rigid_motion.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using shell::Cloth;
using shell::Integrator;
using shell::Vectors;

namespace
{
StressCase hang(const char *const group, const std::string &name, const SheetStiffness &stiffness,
                const double h, const int n_steps)
{
  const auto run = [=](const unsigned int seed) -> StressAnswer
  {
    const meshes::ClothMesh mesh = hanging_mesh();
    Cloth cloth                  = sheet_cloth(mesh, stiffness, upper_corners());
    Vectors velocities           = 2. * meshes::random_vectors(mesh.n_vertices(), seed); // [m/s]
    for (const int v : upper_corners())
      velocities.row(v).setZero();
    cloth.set_state(mesh.positions, velocities, 0.);
    const double growth = largest_energy_growth(cloth, h, n_steps);
    return {growth, state_of(cloth)};
  };
  const Limit limit = {
    energy_round_off, "largest growth in a step over the largest energy [-]",
    "theory: nothing brings energy into the sheet, and damping takes some; round-off: 1e-12 of the "
    "energy before and of what is stored, in up to five parts of a step that was cut"};
  return {
    group, name, "finite; the energy of the damped sheet never grows", limit, Repeats::with_seeds,
    run};
}

/// A free sheet that spins about its normal [1/s], and flies.
Cloth spinning_cloth(const SheetStiffness &stiffness, const double omega,
                     const Integrator integrator)
{
  const meshes::ClothMesh mesh = lying_mesh();
  SheetPhysics physics;
  physics.damping = 0.;
  physics.gravity.setZero();
  physics.options.integrator      = integrator;
  Cloth cloth                     = sheet_cloth(mesh, stiffness, {}, physics);
  Vectors velocities              = Vectors::Zero(mesh.n_vertices(), 3);
  const Eigen::RowVector3d centre = shell::centre_of_mass(cloth.masses(), mesh.positions);
  for (Eigen::Index i = 0; i < velocities.rows(); ++i)
    velocities.row(i) = Eigen::RowVector3d(0.3, 0.1, -0.2) +
                        Eigen::RowVector3d(0., 0., omega).cross(mesh.positions.row(i) - centre);
  cloth.set_state(mesh.positions, velocities, 0.);
  return cloth;
}

/// Whether each of 50 steps is right. Both Euler methods keep the linear momentum and let the
/// energy fall, the conserving one keeps both momenta too: to ten digits. Of a rigid body with the
/// angular velocity ω the motion (x_{n+1} − x_n)/h has the share 1/sqrt(1 + (h ω)²) of its angular
/// momentum with implicit Euler, 1/(1 + (h ω/2)²) with the midpoint rule: at least half of that is
/// asked for, where a sheet that freezes has none.
bool keeps_and_turns(Cloth &cloth, const Integrator integrator, const double h)
{
  const Eigen::VectorXd &m   = cloth.masses();
  const Eigen::RowVector3d p = cloth.momentum(), L = cloth.angular_momentum();
  const double size    = m.dot(cloth.velocities().rowwise().norm());
  const bool keeps_all = integrator == Integrator::conserving;
  for (int k = 0; k < 50; ++k)
  {
    const Vectors x               = cloth.positions();
    const Eigen::RowVector3d spin = cloth.angular_momentum();
    const double angle            = h * shell::spin_of(m, x, spin).norm();
    const double of_rigid =
      keeps_all ? 1. / (1. + 0.25 * angle * angle) : 1. / std::sqrt(1. + angle * angle);
    const double growth            = largest_energy_growth(cloth, h, 1);
    const Eigen::RowVector3d moves = shell::angular_momentum(m, x, (cloth.positions() - x) / h);
    const double kept = keeps_all ? (cloth.angular_momentum() - L).norm() / L.norm() : 0.;
    if (!(std::max({growth, (cloth.momentum() - p).norm() / size, kept}) <= 1e-10) ||
        !(moves.dot(spin) / spin.squaredNorm() >= 0.5 * of_rigid))
      return false;
  }
  return true;
}

constexpr double spin_step = 0.01; ///< [s]

/// The turn per step up to which theory says that the sheet holds together.
double safe_turn(const SheetStiffness &stiffness)
{
  const double softest = meshes::symmetric_eigen<3>(stiffness.D).values(0),
               radius  = 0.5 * std::sqrt(2.) * sheet_side;
  return spin_step * std::sqrt(softest / stiffness.areal_density) / radius / (2. * M_PI);
}

/// The safe turn per step over the largest on the ladder up to which all are right.
StressAnswer largest_turn(const SheetStiffness &stiffness, const Integrator integrator)
{
  double largest = 0.;
  Eigen::MatrixXd state;
  for (const double multiple : {0.25, 1., 2., 4., 8., 16.})
  {
    const double omega = 2. * M_PI * multiple * safe_turn(stiffness) / spin_step;
    Cloth cloth        = spinning_cloth(stiffness, omega, integrator);
    try
    {
      if (!keeps_and_turns(cloth, integrator, spin_step))
        break;
    }
    catch (const meshes::NotConverged &)
    {
      break; // refused: here the axis ends
    }
    largest = multiple;
    state   = state_of(cloth);
  }
  return {1. / largest, state};
}
} // namespace

std::vector<StressCase> time_step_cases(const std::vector<SheetStiffness> &stiffnesses)
{
  std::vector<StressCase> cases;
  for (const SheetStiffness &stiffness : stiffnesses)
    for (const double h : {1e-5, 1e-4, 1e-3, 1e-2, 5e-2, 0.1, 1.})
      cases.push_back(hang("time step",
                           short_text(h) + " s; random velocities of 2 m/s; " + stiffness.name,
                           stiffness, h, h < 0.05 ? 60 : 30));
  return cases;
}

std::vector<StressCase> stiffness_cases()
{
  std::vector<StressCase> cases;
  for (const double young : {1e-2, 1., 1e2, 1e4, 1e6, 1e8})
    for (const double density : {0.01, 0.1, 1., 10.})
    {
      SheetStiffness stiffness = isotropic_sheet(young, 0.3);
      stiffness.areal_density  = density;
      cases.push_back(hang("stiffness",
                           short_text(young) + " N/m; " + short_text(density) + " kg/m^2",
                           stiffness, 0.005, 50));
    }
  return cases;
}

std::vector<StressCase> spin_cases(const std::vector<SheetStiffness> &stiffnesses)
{
  const std::vector<std::pair<Integrator, const char *>> integrators = {
    {Integrator::linearly_implicit, "linearly implicit"},
    {Integrator::implicit, "implicit"},
    {Integrator::conserving, "conserving"}};
  const Limit limit = {
    1., "turn per step that stretches by half over the largest that is right [-]",
    "theory: a sheet of radius r and density rho that spins with omega is stretched by rho omega^2 "
    "r^2/2 over its softest stiffness, twice as much as it swings: below a half no triangle is "
    "crushed, momenta are kept and the sheet turns as a rigid body does; what it may do beyond, "
    "thrown apart, no theory says"};
  std::vector<StressCase> cases;
  for (const SheetStiffness &stiffness : stiffnesses)
    for (const auto &[integrator, name] : integrators)
      cases.emplace_back(
        "spin", std::string(name) + "; " + stiffness.name,
        "right up to " + short_text(safe_turn(stiffness)) + " turns per step of 10 ms or more",
        limit, integrator == Integrator::conserving ? Repeats::once : Repeats::twice, // it is slow
        [=, integrator = integrator](unsigned int) { return largest_turn(stiffness, integrator); });
  return cases;
}
} // namespace homespun::verification
