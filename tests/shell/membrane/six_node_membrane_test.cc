// SPDX-License-Identifier: MIT
// Six-node triangles against closed forms of plane elasticity, their own derivatives and the
// three-node membrane.
#include "meshes/plain/sheet.h"
#include "shell/membrane/six_node_membrane.h"
#include "shell/solver/equilibrium.h"
#include "tests/refusal.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace homespun;
using namespace homespun::shell;

namespace
{
constexpr double young = 1000., poisson = 0.3; // N/m

Eigen::Matrix3d isotropic()
{
  Eigen::Matrix3d C;
  C << 1., poisson, 0., poisson, 1., 0., 0., 0., 0.5 * (1. - poisson);
  return young / (1. - poisson * poisson) * C;
}

meshes::TriangleMesh coarse(const int n)
{
  Eigen::Matrix2d steps;
  steps << 1., 0., 0.3, 0.8;
  return meshes::coarse_sheet({-0.4, 0.2}, steps / n, n, n);
}

std::vector<int> edges_of(const int n)
{
  std::vector<int> held;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      if (i == 0 || j == 0 || i == n || j == n)
        held.push_back(j * (n + 1) + i);
  return held;
}

using Field = std::function<Eigen::RowVector2d(double, double)>;

/// Largest distance at the nodes of the linear equilibrium from a field that is prescribed at all
/// edges and is in equilibrium there without loads.
double error_at_nodes(const int n, const Field &field)
{
  const meshes::TriangleMesh mesh = coarse(n);
  Positions<2> exact              = mesh.vertices;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    exact.row(v) += field(mesh.vertices(v, 0), mesh.vertices(v, 1));
  const MembraneSolver solver(six_node_membrane(six_node_mesh(mesh, n, n), isotropic()),
                              edges_of(n));
  return (solver.solve_linear(exact) - exact).rowwise().norm().maxCoeff();
}

/// Pure bending about the third axis: sigma_11 = E y, nothing else.
Eigen::RowVector2d bent(const double x, const double y)
{
  return {x * y, -0.5 * (x * x + poisson * y * y)};
}

/// The gradient of exp(2 x) cos(2 y), which is harmonic: no change of area, no rotation.
Eigen::RowVector2d swept(const double x, const double y)
{
  return {2. * std::exp(2. * x) * std::cos(2. * y), -2. * std::exp(2. * x) * std::sin(2. * y)};
}

Positions<2> moved(const Positions<2> &rest)
{
  Positions<2> positions = rest;
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> random(-0.02, 0.02);
  for (Eigen::Index k = 0; k < positions.size(); ++k)
    positions.data()[k] += random(generator);
  Eigen::Matrix2d F;
  F << 1.2, 0.3, -0.1, 0.9;
  return positions * F.transpose();
}
} // namespace

TEST(exact_six_node_membrane, a_field_of_second_degree_in_equilibrium_is_found_to_round_off)
{
  EXPECT_LT(error_at_nodes(2, bent), 1e-13);
  EXPECT_LT(error_at_nodes(6, bent), 1e-13);
}

TEST(order_six_node_membrane, a_smooth_field_converges_with_order_three_or_more)
{
  const double coarse = error_at_nodes(8, swept), fine = error_at_nodes(16, swept);
  EXPECT_GT(fine, 1e-9);
  // Three is that of interpolation; linear functions have two.
  EXPECT_GT(std::log2(coarse / fine), 2.8);
}

TEST(exact_six_node_membrane, an_even_motion_has_the_energy_and_no_forces_within)
{
  const meshes::TriangleMesh mesh = coarse(4);
  const SixNodeMembrane six       = six_node_membrane(six_node_mesh(mesh, 4, 4), isotropic());
  const Membrane three            = membrane(mesh, {isotropic()});
  Eigen::Matrix2d F;
  F << 1.3, 0.2, -0.1, 0.8;
  const Positions<2> positions = mesh.vertices * F.transpose();
  const double energy          = membrane_energy<2>(three, positions);
  EXPECT_NEAR(membrane_energy<2>(six, positions), energy, 1e-13 * energy);
  const MembraneGradient<2> gradient = membrane_gradient<2>(six, positions);
  for (int j = 1; j < 4; ++j)
    for (int i = 1; i < 4; ++i)
      EXPECT_LT(gradient.gradient.row(5 * j + i).norm(), 1e-12 * gradient.magnitude.norm());
  EXPECT_LT(gradient.gradient.colwise().sum().norm(), 1e-12 * gradient.magnitude.norm());
}

TEST(derivative_six_node_membrane, gradient_and_hessian_are_those_of_the_energy)
{
  const meshes::TriangleMesh mesh = coarse(2);
  SixNodeMembrane six             = six_node_membrane(six_node_mesh(mesh, 2, 2), isotropic());
  meshes::CubicForm cubic;
  cubic.derivatives.setLinSpaced(-2. * young, 3. * young);
  for (const bool has_cubic : {false, true})
  {
    if (has_cubic)
      add_cubic_energy(six.points, {cubic});
    const Positions<2> at = moved(mesh.vertices);
    Positions<2> along    = moved(at) - at;
    along.row(4).setZero(); // held below
    const double step          = 1e-5;
    const Positions<2> forward = at + step * along, back = at - step * along;
    const double slope =
      (membrane_energy<2>(six, forward) - membrane_energy<2>(six, back)) / (2. * step);
    const Positions<2> gradient = membrane_gradient<2>(six, at).gradient;
    EXPECT_NEAR(gradient.cwiseProduct(along).sum(), slope, 1e-8 * std::abs(slope));
    std::vector<bool> is_held(9, false);
    is_held[4] = true;
    PlaneMatrix matrix(six.triangles, is_held);
    add_membrane_hessian(six, at, Hessian::exact, matrix);
    Positions<2> change =
      (membrane_gradient<2>(six, forward).gradient - membrane_gradient<2>(six, back).gradient) /
      (2. * step);
    change.row(4).setZero();
    EXPECT_LT((matrix.multiply(along) - change).norm(), 1e-7 * change.norm());
  }
}

TEST(invariant_six_node_membrane, a_turn_changes_no_energy_and_turns_the_forces)
{
  const meshes::TriangleMesh mesh = coarse(2);
  const SixNodeMembrane six       = six_node_membrane(six_node_mesh(mesh, 2, 2), isotropic());
  const Positions<2> at           = moved(mesh.vertices);
  const Eigen::Matrix2d R         = Eigen::Rotation2Dd(2.1).toRotationMatrix();
  const Positions<2> turned       = at * R.transpose();
  const double energy             = membrane_energy<2>(six, at);
  EXPECT_NEAR(membrane_energy<2>(six, turned), energy, 1e-13 * energy);
  const Positions<2> forces = membrane_gradient<2>(six, at).gradient * R.transpose();
  EXPECT_LT((membrane_gradient<2>(six, turned).gradient - forces).norm(), 1e-12 * forces.norm());
}

TEST(exact_six_node_membrane, the_equilibrium_at_finite_strain_has_no_forces_and_least_energy)
{
  const int n                     = 6;
  const meshes::TriangleMesh mesh = coarse(n);
  const MembraneSolver solver(six_node_membrane(six_node_mesh(mesh, n, n), isotropic()),
                              edges_of(n));
  Positions<2> start = mesh.vertices;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    start.row(v) += 0.2 * bent(mesh.vertices(v, 0), mesh.vertices(v, 1));
  const Equilibrium found = solver.solve_equilibrium(start);
  EXPECT_GE(found.iterations, 2);
  EXPECT_EQ(found.inverted_triangles, 0);
  const SixNodeMembrane &six         = solver.rest_membrane();
  const MembraneGradient<2> gradient = membrane_gradient<2>(six, found.positions);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> random(-1e-3, 1e-3);
  Positions<2> nearby = found.positions;
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i)
    {
      const int v = j * (n + 1) + i;
      EXPECT_LT(gradient.gradient.row(v).norm(), 1e-9 * gradient.magnitude.maxCoeff());
      nearby.row(v) += Eigen::RowVector2d(random(generator), random(generator));
    }
  EXPECT_NEAR(membrane_energy<2>(six, found.positions), found.energy, 1e-14 * found.energy);
  EXPECT_GT(membrane_energy<2>(six, nearby), found.energy);
}

TEST(tripwire_six_node_membrane, quads_that_do_not_pair_are_refused)
{
  EXPECT_NE(tests::refusal([]() { six_node_mesh(coarse(3), 3, 3); })
              .find("two quads wide, they do not fill 3 x 3"),
            std::string::npos);
}
