// SPDX-License-Identifier: MIT
// A clamped strip that hangs over under its weight: large rotations, against the elastica.
#include "shell/solver/cloth.h"
#include "shell/terms/edge_angles.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "tests/shell/shell_cases.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace homespun;
using namespace homespun::shell;

namespace
{
/// Weight rho g L³/D of an inextensible strip, and how far its tip drops over how far it reaches:
/// the boundary value problem theta'' = −weight (1 − s) cos(theta), solved by two independent
/// programs.
struct Droop
{
  double weight, value;
};
const std::vector<Droop> elastica = {{0.1, 0.012500},   {1., 0.124562},    {2., 0.246673},
                                     {5., 0.585721},    {10., 1.066802},   {20., 1.863930},
                                     {50., 3.705561},   {100., 5.888105},  {200., 8.906771},
                                     {500., 14.768803}, {1000., 21.335440}};

/// A strip of length 1 and bending stiffness 1, n x 2 squares whose diagonals alternate, clamped
/// where it begins.
struct Strip
{
  explicit Strip(const int n)
      : n(n)
  {
    meshes::TriangleMesh rest =
      meshes::coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity() / n, n, 2);
    const auto vertex = [n](const int i, const int j) { return j * (n + 1) + i; };
    for (int j = 0, t = 0; j < 2; ++j)
      for (int i = 0; i < n; ++i, t += 2)
        if ((i + j) % 2 == 1)
        {
          rest.triangles.row(t) << vertex(i, j), vertex(i + 1, j), vertex(i, j + 1);
          rest.triangles.row(t + 1) << vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1);
        }
    rest.material = Eigen::VectorXi::Zero(rest.n_triangles());
    mesh          = meshes::placed_sheet(rest, Eigen::Matrix3d::Identity().leftCols<2>(),
                                         Eigen::RowVector3d::Zero());
  }

  /// Equilibria of growing weight, each from the one before. @return drop over reach of each
  std::vector<double> droops(const std::vector<Droop> &wanted)
  {
    std::vector<double> result;
    for (const Droop &one : wanted)
    {
      const Eigen::VectorXd masses = lumped_masses(mesh, {one.weight});
      Cloth cloth(mesh.positions, masses, {0, n + 1, 2 * (n + 1)});
      // Stretches stay below 1e-4.
      cloth.add(membrane_term(mesh, {tests::isotropic(1e7, 0.)}));
      cloth.add(edge_angles_term(mesh, {PlateStiffness::isotropic(1., 0.)},
                                 {{0, n + 1, {0., 0., 1.}}, {n + 1, 2 * (n + 1), {0., 0., 1.}}}));
      cloth.add(gravity_term(masses, {0., 0., -1.}));
      cloth.solve_equilibrium();
      mesh.positions               = cloth.positions();
      const Eigen::RowVector3d tip = mesh.positions.row(n + 1 + n);
      result.push_back(-tip(2) / tip(0));
    }
    return result;
  }

  const int n;
  meshes::ClothMesh mesh;
};
} // namespace

// A handle turns the planes of edges with it within the one linear solve of a step.
TEST(order_edge_angles, a_linearly_implicit_step_of_a_moved_handle_leaves_an_error_of_second_order)
{
  const Strip strip(6);
  const Eigen::VectorXd masses = lumped_masses(strip.mesh, {1e-3});
  const auto moved             = [&](const Integrator integrator, const double height)
  {
    ClothOptions options;
    options.integrator       = integrator;
    options.newton_tolerance = 1e-12;
    Cloth cloth(strip.mesh.positions, masses, {0, 7, 14, 10}, options);
    cloth.add(membrane_term(strip.mesh, {tests::isotropic(1e3, 0.3)}));
    cloth.add(edge_angles_term(strip.mesh, {PlateStiffness::isotropic(1., 0.3)}));
    cloth.prescribe(10, strip.mesh.positions.row(10) + Eigen::RowVector3d(0., 0., height));
    cloth.step(0.1);
    return cloth.positions();
  };
  std::vector<double> heights, errors;
  for (const double height : {4e-3, 2e-3, 1e-3, 5e-4})
  {
    heights.push_back(height);
    errors.push_back(
      (moved(Integrator::linearly_implicit, height) - moved(Integrator::implicit, height)).norm());
  }
  std::cout << "errors " << errors[0] << " ... " << errors[3] << '\n';
  EXPECT_NEAR(tests::slope(heights, errors), 2., 0.1);
}

TEST(order_elastica, a_strip_that_hangs_over_droops_like_the_elastica_with_order_two)
{
  std::vector<double> widths, errors;
  for (const int n : {8, 16, 32, 64})
  {
    widths.push_back(1. / n);
    errors.push_back(std::abs(Strip(n).droops({elastica[2]})[0] / elastica[2].value - 1.));
    std::cout << "n " << n << ": " << errors.back() << '\n';
  }
  EXPECT_NEAR(tests::slope(widths, errors), 2., 0.15);
  EXPECT_LT(errors[2], 0.003);
}

TEST(bound_elastica, the_droop_of_all_weights_is_met_to_one_per_cent)
{
  const std::vector<double> found = Strip(100).droops(elastica);
  for (std::size_t k = 0; k < elastica.size(); ++k)
  {
    std::cout << elastica[k].weight << ": " << found[k] << ", error "
              << found[k] / elastica[k].value - 1. << '\n';
    EXPECT_NEAR(found[k], elastica[k].value, 0.01 * elastica[k].value);
  }
}
