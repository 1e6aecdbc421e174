// SPDX-License-Identifier: MIT
// Equilibria of resolved cloth that cannot be pressed: the law yarn-tension.
#include "homogenization/lint/cell_reading.h"
#include "shell/membrane/tension_field.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/laws/ellipticity.h"
#include "verification/reference/fine_reference.h"
#include "verification/yarns/tension_field.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

using namespace homespun;
using namespace homespun::verification;
using homogenization::UnitCell;

namespace
{
std::vector<homogenization::Phase> two_cloths()
{
  return {{"straight", 1e3, 8e2, 0.1, 20., 0., 1., 1.}, {"turned", 3e2, 1e2, 0.2, 5., 35., 1., 1.}};
}

/// The least value of a convex function of the plane, by steps along the axes that shrink.
double least_value(const std::function<double(const Eigen::Vector2d &)> &f, const double first)
{
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  double least      = f(x);
  for (double step = first; step > 1e-10;)
  {
    bool is_better = false;
    for (int k = 0; k < 8; ++k)
    {
      const double angle          = 0.25 * M_PI * k;
      const Eigen::Vector2d trial = x + step * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (const double value = f(trial); value < least)
      {
        least     = value;
        x         = trial;
        is_better = true;
      }
    }
    if (!is_better)
      step *= 0.5;
  }
  return least;
}
} // namespace

// Each layer deforms evenly, F_k = I + a_k e2^T with the mean of the a_k given: two numbers are
// left, and the coarse cloth's writing of the law has the energy.
TEST(exact_tension_equilibrium, layers_that_are_sheared_have_the_energy_of_an_independent_search)
{
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 4, 4, two_cloths(), tests::halves);
  const std::vector<Eigen::Matrix3d> stiffness = cell.stiffness_of_phase();
  const meshes::Sheet sheet                    = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  FineReference reference(sheet, stiffness, {}, MPI_COMM_SELF);
  reference.start(Load("periodic-12"), Law::yarn_tension);
  for (const double shear : {0.01, 0.1, 0.3})
  {
    const ReferenceStep step = reference.advance(shear);
    ASSERT_TRUE(step.reached) << step.why;
    const auto layer = [&](const std::size_t k, const Eigen::Vector2d &a)
    {
      Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
      F.col(1) += a;
      return shell::tension_field<2>(F, meshes::yarn_axes(stiffness[k]));
    };
    int n_wrinkled     = 0;
    const double least = least_value(
      [&](const Eigen::Vector2d &half)
      {
        const Eigen::Vector2d mean(shear, 0.);
        const auto lower = layer(0, mean + half), upper = layer(1, mean - half);
        n_wrinkled =
          (lower.state != shell::TensionState::taut) + (upper.state != shell::TensionState::taut);
        return 0.5 * (lower.energy + upper.energy);
      },
      shear);
    EXPECT_GT(n_wrinkled, 0) << shear; // else the law is yarn
    EXPECT_NEAR(step.energy / cell.lattice.area(), least, 1e-8 * least) << shear;
    EXPECT_LT(step.relative_residual, 1e-9) << shear;
  }
}

// What is relaxed costs no more than what is not; which way a state was reached changes neither its
// energy nor its forces, though where wrinkles lie it may change the positions.
TEST(bound_tension_equilibrium, strips_of_a_weave_have_the_energy_of_one_minimum_whatever_the_way)
{
  const UnitCell cell = homogenization::read_unit_cell(std::string(CELLS) + "plain-weave.prm");
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  const auto solved         = [&](const Law law, const std::vector<double> &strains)
  {
    FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_SELF);
    reference.start(Load("strip-1"), law);
    ReferenceStep step;
    for (const double strain : strains)
      step = reference.advance(strain);
    EXPECT_TRUE(step.reached) << name_of(law) << ": " << step.why;
    return step;
  };
  const ReferenceStep yarn = solved(Law::yarn, {0.05}), at_once = solved(Law::yarn_tension, {0.05}),
                      in_steps  = solved(Law::yarn_tension, {0.001, 0.01, 0.05}),
                      backwards = solved(Law::yarn_tension, {0.1, 0.05});
  const auto pull = [](const ReferenceStep &step) { return step.forces.on_clamps(1, 0); };
  for (const ReferenceStep *const other : {&in_steps, &backwards})
  {
    EXPECT_NEAR(other->energy, at_once.energy, 1e-9 * at_once.energy);
    EXPECT_NEAR(pull(*other), pull(at_once), 1e-6 * pull(at_once));
  }
  EXPECT_LE(at_once.energy, yarn.energy);
  int n_relaxed = 0;
  for (const PhaseEllipticity &phase : ellipticity_of_phases(sheet.mesh, cell.stiffness_of_phase(),
                                                             Law::yarn_tension, at_once.positions))
    n_relaxed += phase.n_wrinkled + phase.n_slack;
  EXPECT_GT(n_relaxed, 0); // else the law is yarn
}

// Next to nothing of a frame that is sheared little is taut, and wrinkle by wrinkle its equilibrium
// takes more than a hundred steps. What is small is so in proportion: the law has no other scale,
// and the energy goes with the square of the shear.
TEST(exact_tension_equilibrium, a_frame_that_is_sheared_little_has_the_energy_of_small_strains)
{
  const UnitCell cell = homogenization::read_unit_cell(std::string(CELLS) + "plain-weave.prm");
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 3, 3);
  const auto energy         = [&](const double strain)
  {
    FineReference reference(sheet, cell.stiffness_of_phase(), {}, MPI_COMM_SELF);
    reference.start(Load("shear-frame"), Law::yarn_tension);
    const ReferenceStep step = reference.advance(strain);
    EXPECT_TRUE(step.reached) << step.why;
    EXPECT_LT(step.relative_residual, 1e-7);
    return step.energy;
  };
  EXPECT_NEAR(std::log2(energy(0.002) / energy(0.001)), 2., 0.05);
}
