// SPDX-License-Identifier: MIT
// A free sheet that spins, and what theory promises of each integrator. Both Euler methods keep the
// linear momentum and let the energy fall; of the angular momentum they lose a share in each step.
// The conserving one keeps all three. Whether a sheet turns at all is judged by its motion,
// (x_{n+1} − x_n)/h: of a rigid body with the angular velocity ω implicit Euler leaves the share
// 1/sqrt(1 + (h ω)²) of its angular momentum in it, the midpoint rule 1/(1 + (h ω/2)²).
#include "shell/solver/rigid_motion.h"
#include "verification/extremes/stress_cases.h"
#include "verification/record/fields.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
using shell::Cloth;
using shell::Integrator;
using shell::Vectors;

namespace
{
const char *const of_what_is_kept = "theory: both Euler methods keep the linear momentum and let "
                                    "the energy fall, the conserving one keeps the energy and "
                                    "both momenta to its solve, which ends at 1e-8 of the forces "
                                    "and once more by Newton's method, which squares that; "
                                    "requirement: ten digits over all steps";
const char *const of_turning = "theory gives the share of the angular momentum in the motion of a "
                               "step, 1/sqrt(1 + (h omega)^2) of implicit Euler and 1/(1 + (h "
                               "omega/2)^2) of the midpoint rule for a rigid body; requirement: "
                               "no step has less than half of it, where a sheet that freezes has "
                               "none";

struct Spin
{
  std::string name;
  double h;                            ///< [s]
  Eigen::RowVector3d angular_velocity; ///< [rad/s]
  double disturbance;                  ///< size of random velocities [m/s]
  bool is_thrown; ///< its momentum is measured against itself, else against what its vertices have
};

std::vector<Spin> spins()
{
  std::vector<Spin> all;
  for (const double h : {1e-3, 5e-3, 2e-2})
    all.push_back({"thrown; " + short_text(1e3 * h) + " ms", h, {3., -2., 10.}, 0.1, true});
  for (const double turns : {0.25, 0.5, 1., 5.})
    all.push_back({short_text(turns) + " turns per step of 10 ms",
                   0.01,
                   {0., 0., 2. * M_PI * turns / 0.01},
                   0.,
                   false});
  return all;
}

Cloth spinning_cloth(const SheetStiffness &stiffness, const Spin &spin, const Integrator integrator,
                     const unsigned int seed)
{
  const meshes::ClothMesh mesh = lying_mesh(cells_per_side);
  SheetPhysics physics;
  physics.damping = 0.;
  physics.gravity.setZero();
  physics.options.integrator = integrator;
  Cloth cloth                = sheet_cloth(mesh, stiffness, {}, physics);
  Vectors velocities         = spinning(mesh.positions, cloth.masses(), spin.angular_velocity) +
                       spin.disturbance * meshes::random_vectors(mesh.n_vertices(), seed);
  velocities.rowwise() += Eigen::RowVector3d(0.3, 0.1, -0.2);
  cloth.set_state(mesh.positions, velocities, 0.);
  return cloth;
}

/// The largest change of what is kept.
StressAnswer keep(Cloth cloth, const Spin &spin, const bool and_spin, const int n_steps)
{
  const Eigen::RowVector3d p = cloth.momentum(), L = cloth.angular_momentum();
  const double size =
    spin.is_thrown ? p.norm() : cloth.masses().dot(cloth.velocities().rowwise().norm());
  double worst = 0.;
  for (int k = 0; k < n_steps; ++k)
  {
    worst = std::max(
      {worst, largest_energy_growth(cloth, spin.h, 1), (cloth.momentum() - p).norm() / size});
    if (and_spin)
      worst = std::max(worst, (cloth.angular_momentum() - L).norm() / L.norm());
  }
  return {worst, state_of(cloth)};
}

/// The share of the angular momentum that theory leaves in the motion over that which is seen, the
/// largest of all steps.
StressAnswer turn(Cloth cloth, const Spin &spin, const Integrator integrator, const int n_steps)
{
  const Eigen::VectorXd &m = cloth.masses();
  double worst             = 0.;
  for (int k = 0; k < n_steps; ++k)
  {
    const Vectors x            = cloth.positions();
    const Eigen::RowVector3d L = cloth.angular_momentum();
    const double angle         = spin.h * shell::spin_of(m, x, L).norm();
    const double theory = integrator == Integrator::conserving ? 1. / (1. + 0.25 * angle * angle)
                                                               : 1. / std::sqrt(1. + angle * angle);
    cloth.step(spin.h);
    const Eigen::RowVector3d seen = shell::angular_momentum(m, x, (cloth.positions() - x) / spin.h);
    const double share            = seen.dot(L) / L.squaredNorm();
    // A sheet that does not turn, or turns back, has no share.
    worst = std::max(worst, theory / std::max(share, 1e-30));
  }
  return {worst, state_of(cloth)};
}
} // namespace

std::vector<StressCase> spin_cases(const std::vector<SheetStiffness> &stiffnesses)
{
  const std::vector<std::pair<Integrator, std::string>> integrators = {
    {Integrator::linearly_implicit, "linearly implicit"},
    {Integrator::implicit, "implicit"},
    {Integrator::conserving, "conserving"}};
  std::vector<StressCase> cases;
  CaseGroup group("spin", cases);
  for (const SheetStiffness &stiffness : stiffnesses)
    for (const Spin &spin : spins())
      for (const auto &[integrator, name] : integrators)
      {
        const bool keeps_all     = integrator == Integrator::conserving;
        const int n_steps        = spin.is_thrown ? 100 : 50;
        const std::string called = spin.name + "; " + name + "; " + stiffness.name;
        const auto add           = [&](const std::string &what, const std::string &expected,
                             const Figure &figure, const auto &run)
        {
          StressCase &one = group.finite(what + called, expected, figure, run);
          one.is_random   = spin.disturbance > 0.;
          one.derivation  = what == "keeps; " ? of_what_is_kept : of_turning;
          if (keeps_all) // it solves with LU: a second look is enough
            one.most_repeats = 2;
        };
        add("keeps; ",
            keeps_all ? "finite; keeps both momenta; energy never grows"
                      : "finite; keeps its linear momentum; energy never grows",
            {1e-10, std::string("largest relative change of ") +
                      (keeps_all ? "momenta" : "momentum") + " or growth of energy in a step [-]"},
            [=, integrator = integrator](const unsigned int seed) {
              return keep(spinning_cloth(stiffness, spin, integrator, seed), spin, keeps_all,
                          n_steps);
            });
        add("turns; ", "finite; in no step less than half of the turning that theory leaves",
            {2.,
             "angular momentum in the motion of a step by theory over that which is seen; largest "
             "[-]"},
            [=, integrator = integrator](const unsigned int seed) {
              return turn(spinning_cloth(stiffness, spin, integrator, seed), spin, integrator,
                          n_steps);
            });
      }
  return cases;
}
} // namespace homespun::verification
