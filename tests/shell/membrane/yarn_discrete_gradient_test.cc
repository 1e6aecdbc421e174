// SPDX-License-Identifier: MIT
// Yarns over a conserving step: the work of their forces, what they turn, their derivative, and
// what a cloth of them keeps.
#include "shell/membrane/yarn_discrete_gradient.h"
#include "shell/membrane/yarn_energy.h"
#include "shell/terms/yarn_term.h"
#include "tests/refusal.h"
#include "tests/shell/solver/cloth_cases.h"
#include "tests/shell/terms/term_cases.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::shell;
using namespace homespun::tests;

namespace
{
/// Two states of a triangle of yarns: each stretched and sheared by a third or so, and turned in
/// its own way.
struct TwoStates
{
  RestTriangle rest;
  Eigen::Matrix3d before, after;
};

TwoStates two_states(std::mt19937 &generator)
{
  Eigen::Matrix<double, 3, 2> corners;
  corners << 0., 0., 0.01, 0.001, 0.003, 0.012;
  const auto state = [&]() -> Eigen::Matrix3d
  {
    Eigen::Matrix<double, 3, 2> F = Eigen::Matrix<double, 3, 2>::Identity();
    F += 0.4 * random_matrix<Eigen::Matrix<double, 3, 2>>(generator, 3, 2);
    return corners * F.transpose() * rotation<3>(3. * generator() / double(std::mt19937::max()));
  };
  return {rest_triangle(corners), state(), state()};
}

double energy_of(const RestTriangle &rest, const Eigen::Matrix3d &corners,
                 const meshes::YarnAxes &yarns)
{
  return rest.area * yarn_energy_density<3>(deformation_gradient<3>(rest, corners), yarns);
}
} // namespace

TEST(exact_yarn_step, forces_of_a_triangle_do_the_work_that_its_energy_takes_whatever_the_step)
{
  std::mt19937 generator(2);
  const meshes::YarnAxes yarns = meshes::yarn_axes(anisotropic());
  for (int k = 0; k < 200; ++k)
  {
    const TwoStates states = two_states(generator);
    const Eigen::Matrix3d g =
      yarn_triangle_step(states.rest, states.before, states.after, yarns).gradient;
    const double before = energy_of(states.rest, states.before, yarns),
                 after  = energy_of(states.rest, states.after, yarns);
    EXPECT_NEAR(g.cwiseProduct(states.after - states.before).sum(), after - before,
                1e-12 * std::max({before, after, g.norm() * 0.01}))
      << k;
    EXPECT_LT(g.colwise().sum().norm(), 1e-13 * g.norm());
    EXPECT_LT(torque(0.5 * (states.before + states.after), g).norm(), 1e-13 * g.norm() * 0.02);
    // At rest they are the gradient.
    const Eigen::Matrix3d gradient = yarn_triangle_gradient<3>(states.rest, states.after, yarns);
    EXPECT_LT(
      (yarn_triangle_step(states.rest, states.after, states.after, yarns).gradient - gradient)
        .norm(),
      1e-12 * gradient.norm());
  }
}

TEST(derivative_yarn_step, the_matrix_of_a_triangle_is_the_derivative_of_its_forces)
{
  std::mt19937 generator(4);
  const meshes::YarnAxes yarns = meshes::yarn_axes(anisotropic());
  for (int k = 0; k < 20; ++k)
  {
    TwoStates states = two_states(generator);
    if (k % 2 == 0) // a short step
      states.after = states.before + 1e-3 * (states.after - states.before);
    const Eigen::Matrix3d change = 1e-3 * random_matrix<Eigen::Matrix3d>(generator, 3, 3);
    const TriangleStep at = yarn_triangle_step(states.rest, states.before, states.after, yarns);
    Eigen::Matrix<double, 9, 1> direction;
    for (int corner = 0; corner < 3; ++corner)
      direction.segment<3>(3 * corner) = change.row(corner).transpose();
    const Eigen::Matrix<double, 9, 1> slopes = at.jacobian * direction;
    std::vector<double> steps, remainders;
    for (double h = 1. / 64.; h > 2e-4; h *= 0.5)
    {
      Eigen::Matrix3d remainder =
        yarn_triangle_step(states.rest, states.before, states.after + h * change, yarns).gradient -
        at.gradient;
      for (int corner = 0; corner < 3; ++corner)
        remainder.row(corner) -= h * slopes.segment<3>(3 * corner).transpose();
      steps.push_back(h);
      remainders.push_back(remainder.norm());
    }
    EXPECT_NEAR(slope(steps, remainders), 2., 0.1) << k;
  }
}

TEST(invariant_yarn_step, an_undamped_sheet_of_yarns_keeps_energy_and_momenta)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  const Eigen::VectorXd masses = lumped_masses(mesh, {0.2});
  Eigen::Matrix3d weave;
  weave << 2000., 300., 0., 300., 900., 0., 0., 0., 40.;
  ClothOptions options;
  options.integrator = Integrator::conserving;
  for (const double h : {1e-4, 1e-3})
  {
    Cloth cloth(mesh.positions, masses, {}, options);
    cloth.add(yarn_term(mesh, {weave}));
    std::mt19937 generator(6);
    Vectors v = 0.2 * random_matrix<Vectors>(generator, mesh.n_vertices(), 3);
    v += 5. * (mesh.positions * Eigen::Matrix3d(rotation<3>(M_PI / 2.)));
    cloth.set_state(mesh.positions, v, 0.);
    const double energy        = cloth.kinetic_energy() + cloth.stored_energy();
    const Eigen::RowVector3d p = cloth.momentum(), L = cloth.angular_momentum();
    for (int k = 0; k < 100; ++k)
      cloth.step(h);
    EXPECT_NEAR(cloth.kinetic_energy() + cloth.stored_energy(), energy, 1e-9 * energy) << h;
    EXPECT_LT((cloth.momentum() - p).norm(), 1e-11 * p.norm()) << h;
    EXPECT_LT((cloth.angular_momentum() - L).norm(), 1e-9 * L.norm()) << h;
  }
}
