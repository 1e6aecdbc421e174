// SPDX-License-Identifier: MIT
// What pins and handles exert: they carry the cloth, whichever code moves it.
#include "homogenization/lint/cell_reading.h"
#include "shell/membrane/membrane.h"
#include "shell/terms/membrane_term.h"
#include "verification/drape/fine_run.h"
#include "verification/drape/held_forces.h"
#include "verification/reference/space_gradient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double forever = std::numeric_limits<double>::infinity();

DrapedCell draped(const std::string &file, const TimeIntegration integration)
{
  Scene scene = read_scene(std::string(CELLS) + "../scenes/" + file);
  scene.terms.insert("damping"); // the forces must know of it
  scene.damping_rate = 2.;
  scene.viscosity    = 0.;
  scene.integration  = integration;
  scene.n1 = scene.n2 = 4;
  meshes::HomogenizedCell coarse;
  coarse.stiffness << 1500., 330., 120., 330., 600., -90., 120., -90., 270.;
  coarse.areal_density = 0.3;
  return {scene, homogenization::read_unit_cell(std::string(CELLS) + "layered.prm"), coarse,
          Law::biot};
}

Eigen::RowVector3d sum_of(const std::vector<HeldForce> &forces)
{
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const HeldForce &its : forces)
    sum += its.force;
  return sum;
}

/// The full-resolution cloth in three ways.
std::unique_ptr<FineRun> fine_run(const DrapedCell &cell, const std::string &reference)
{
  return reference == "shell" ? shell_run(cell, MPI_COMM_SELF)
                              : dealii_run(cell, law_of(reference), {}, MPI_COMM_SELF);
}
} // namespace

// Equilibria end at 1e-8 of the forces in the cloth, which are some ten times its weight.
TEST(exact_held_forces, pins_carry_the_weight_of_a_cloth_at_rest)
{
  const DrapedCell cell = draped("hang.prm", TimeIntegration::equilibria);
  SceneCloth coarse(cell.scene, cell.coarse, cell.effective, cell.coarse_motion());
  coarse.solve_equilibrium(1.);
  const auto of_coarse =
    held_forces(cell.coarse_motion(),
                {cell.coarse, coarse.cloth().masses(), coarse.cloth().gradient(), 1., forever});
  const Eigen::RowVector3d g = cell.scene.gravity;
  const double weight        = coarse.cloth().masses().sum() * g.norm();
  EXPECT_LT((sum_of(of_coarse) + coarse.cloth().masses().sum() * g).norm(), 1e-6 * weight);
  ASSERT_FALSE(of_coarse.empty());
  EXPECT_EQ(of_coarse.front().place, cell.scene.held.front().place);

  const Eigen::VectorXd masses = shell::lumped_masses(cell.fine, cell.phases.areal_density);
  for (const char *reference : {"shell", "biot", "green"})
  {
    const auto run = fine_run(cell, reference);
    ASSERT_EQ(run->advance(true, 0., 1.).why, "") << reference;
    const auto of_fine =
      held_forces(cell.fine_motion(), {cell.fine, masses, run->gradient(), 1., forever});
    EXPECT_LT((sum_of(of_fine) + masses.sum() * g).norm(), 1e-6 * masses.sum() * g.norm())
      << reference;
  }
}

// Newton's third law over a step of implicit Euler: forces and weight change the momentum, and what
// damping takes is in the gradient.
TEST(exact_held_forces, handles_and_weight_change_the_momentum_of_a_moving_cloth)
{
  const double h        = 0.005;
  const DrapedCell cell = draped("pull.prm", TimeIntegration::implicit);
  const auto check = [&](const std::string &what, const HeldMotion &motion, const HeldCloth &at_end,
                         const Eigen::RowVector3d &rate, const Eigen::RowVector3d &damped)
  {
    const Eigen::RowVector3d weight =
      cell.scene.has("gravity") ? Eigen::RowVector3d(at_end.masses.sum() * cell.scene.gravity)
                                : Eigen::RowVector3d::Zero().eval();
    const std::vector<HeldForce> forces = held_forces(motion, at_end);
    double size                         = 0.; // of forces that pull against each other
    for (const HeldForce &its : forces)
      size += its.force.norm();
    EXPECT_LT((sum_of(forces) + weight + damped - rate).norm(), 1e-6 * size) << what;
    EXPECT_GT(rate.norm(), 1e-4 * size) << what; // a hundred times the limit
  };
  SceneCloth coarse(cell.scene, cell.coarse, cell.effective, cell.coarse_motion());
  for (int k = 1; k <= 5; ++k)
  {
    const Eigen::RowVector3d before = coarse.cloth().momentum();
    coarse.step(h);
    const Eigen::RowVector3d after = coarse.cloth().momentum();
    check("coarse", cell.coarse_motion(),
          {cell.coarse, coarse.cloth().masses(), coarse.cloth().gradient(), k * h, h},
          (after - before) / h, -cell.scene.damping_rate * after);
  }
  const Eigen::VectorXd masses = shell::lumped_masses(cell.fine, cell.phases.areal_density);
  for (const char *reference : {"shell", "biot", "green"})
  {
    const auto run = fine_run(cell, reference);
    for (int k = 1; k <= 3; ++k)
    {
      const Eigen::RowVector3d before = masses.transpose() * run->velocities();
      ASSERT_EQ(run->advance(false, h, k * h).why, "");
      const Eigen::RowVector3d after = masses.transpose() * run->velocities();
      check(reference, cell.fine_motion(), {cell.fine, masses, run->gradient(), k * h, h},
            (after - before) / h, -cell.scene.damping_rate * after);
    }
  }
}

// Two codes of one law.
TEST(exact_space_gradient, of_biots_law_is_that_of_the_shells_membrane)
{
  const DrapedCell cell         = draped("pull.prm", TimeIntegration::implicit);
  meshes::SpacePoints positions = cell.fine.positions;
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    positions.row(v) +=
      1e-4 * Eigen::RowVector3d(std::sin(3. * v), std::cos(5. * v), std::sin(7. * v));
  const shell::Positions<3> of_shell =
    shell::membrane_gradient<3>(shell::membrane(cell.fine, cell.phases.stiffness), positions)
      .gradient;
  const meshes::SpacePoints gradient =
    space_gradient(cell.fine.rest, cell.phases.stiffness, Law::biot, positions);
  EXPECT_LT((gradient - of_shell).norm(), 1e-10 * of_shell.norm());
}
