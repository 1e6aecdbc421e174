// SPDX-License-Identifier: MIT
// Sheets under the law of yarns: the sum over a mesh, and its equilibria.
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "shell/membrane/membrane.h"
#include "shell/membrane/yarn_energy.h"
#include "tests/refusal.h"
#include "tests/shell/dimensions.h"
#include "tests/shell/shell_cases.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::Dimensions;
using homespun::tests::InPlaneAndSpace;

namespace
{
/// Lower and upper edge of a square of n x n x 2 triangles.
std::vector<int> two_edges(const int n)
{
  std::vector<int> held;
  for (int i = 0; i <= n; ++i)
  {
    held.push_back(i);
    held.push_back(n * (n + 1) + i);
  }
  return held;
}

Membrane sheet_of_yarns(const meshes::TriangleMesh &mesh, const Eigen::Matrix3d &C)
{
  Membrane sheet = membrane(mesh, {C});
  take_yarn_law(sheet);
  return sheet;
}
} // namespace

template <typename Dim>
using derivative_yarn_mesh = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(derivative_yarn_mesh, Dimensions);

TYPED_TEST(derivative_yarn_mesh,
           of_a_mesh_the_assembled_forces_and_stiffness_are_those_of_its_energy)
{
  constexpr int dim               = TypeParam::value;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(3);
  const Membrane sheet            = sheet_of_yarns(mesh, tests::anisotropic());
  std::mt19937 generator(6);
  const auto some = [&]()
  { return tests::random_matrix<Positions<dim>>(generator, mesh.n_vertices(), dim); };
  const Positions<dim> x = 1.1 * tests::embedded<dim>(mesh) + 3e-4 * some(), d = 1e-3 * some();
  const auto force = [&](const Positions<dim> &at)
  { return membrane_gradient<dim>(sheet, at).gradient; };
  std::vector<double> steps, of_energy, of_forces;
  for (double h = 1. / 16.; h > 3e-3; h *= 0.5)
  {
    const Positions<dim> ahead = x + h * d, behind = x - h * d;
    steps.push_back(h);
    of_energy.push_back(std::abs(membrane_energy<dim>(sheet, ahead) -
                                 membrane_energy<dim>(sheet, behind) -
                                 2. * h * force(x).cwiseProduct(d).sum()));
    const double stiffness = tests::hessian_times<dim>(sheet, x, d).cwiseProduct(d).sum();
    of_forces.push_back(
      std::abs((force(ahead) - force(behind)).cwiseProduct(d).sum() - 2. * h * stiffness));
  }
  EXPECT_NEAR(tests::slope(steps, of_energy), 3., 0.1);
  EXPECT_NEAR(tests::slope(steps, of_forces), 3., 0.1);
  // A motion as a whole does no work.
  EXPECT_LT(force(x).colwise().sum().norm(), 1e-13 * force(x).norm());
}

TEST(exact_yarn_sheet,
     pulled_along_a_yarn_it_has_the_stress_of_that_yarn_and_narrows_as_poisson_says)
{
  // The yarns stay at right angles and the other one free of tension: l2 − 1 = −nu s, nu = C12/C22,
  // P11 = E s with E = C11 − C12²/C22, at any s: the corotational cloth has the same.
  const int n       = 5;
  const double side = 0.01;
  Eigen::Matrix3d C = tests::plain_weave();
  C(0, 0)           = 70000.; // so that the stiffer yarn is the second one, which is pulled
  const double nu = C(0, 1) / C(0, 0), young = C(1, 1) - C(0, 1) * nu;
  const auto mesh = tests::irregular_sheet(n, side);
  const MembraneSolver solver(sheet_of_yarns(mesh, C), two_edges(n));
  for (const double strain : {0.01, 0.05, 0.3})
  {
    Positions<2> expected = mesh.vertices;
    expected.col(0) *= 1. - nu * strain;
    expected.col(1) *= 1. + strain;
    Positions<2> start = expected;
    for (int v = n + 1; v < n * (n + 1); ++v)
      start.row(v) = 0.9 * expected.row(v) + 0.1 * mesh.vertices.row(v);
    const auto result = solver.solve_equilibrium(start);
    EXPECT_LT((result.positions - expected).cwiseAbs().maxCoeff(), 1e-9 * side) << strain;
    const double energy = 0.5 * young * strain * strain * side * side;
    EXPECT_NEAR(result.energy, energy, 1e-12 * energy) << strain;
    const Positions<2> forces = membrane_gradient<2>(solver.rest_membrane(), expected).gradient;
    EXPECT_NEAR(forces.bottomRows(n + 1).col(1).sum(), young * strain * side, 1e-11 * young * side);
  }
}

TEST(exact_yarn_sheet, turned_with_its_stiffness_a_sheet_of_yarns_moves_alike)
{
  // C and the load turned together by 0.4: the positions turn, and the energy is the same.
  const Eigen::Matrix2d R = tests::rotation<2>(0.4);
  const auto mesh         = tests::irregular_sheet(4);
  auto turned             = mesh;
  turned.vertices         = mesh.vertices * R.transpose();
  // Strains of the turned sheet in the axes of the first one.
  const double c = R(0, 0), s = R(1, 0);
  Eigen::Matrix3d into;
  into << c * c, s * s, c * s, s * s, c * c, -c * s, -2. * c * s, 2. * c * s, c * c - s * s;
  const Eigen::Matrix3d C = into.transpose() * tests::plain_weave() * into;
  const MembraneSolver first(sheet_of_yarns(mesh, tests::plain_weave()), two_edges(4)),
    second(sheet_of_yarns(turned, C), two_edges(4));
  Positions<2> start = mesh.vertices;
  start.bottomRows(5).col(1).array() += 3e-4;
  start.bottomRows(5).col(0).array() += 1e-4;
  const auto straight = first.solve_equilibrium(start);
  const auto other    = second.solve_equilibrium(Positions<2>(start * R.transpose()));
  EXPECT_LT((straight.positions * R.transpose() - other.positions).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_NEAR(straight.energy, other.energy, 1e-9 * straight.energy);
}

TEST(bound_yarn_sheet, a_clamped_strip_of_plain_weave_finds_its_equilibrium_at_five_percent)
{
  // From the straight pull in one step, with the width of both edges held.
  const int n       = 20;
  const double side = 0.1;
  const auto mesh   = tests::parallelogram(tests::square_lattice(side), n, n);
  const MembraneSolver solver(sheet_of_yarns(mesh, tests::plain_weave()), two_edges(n));
  const MembraneSolver corotational(membrane(mesh, {tests::plain_weave()}), two_edges(n));
  for (const double strain : {0.01, 0.05})
  {
    Positions<2> start = mesh.vertices;
    start.col(1) *= 1. + strain;
    const auto result = solver.solve_equilibrium(start);
    EXPECT_LE(result.iterations, 15) << strain;
    EXPECT_EQ(result.inverted_triangles, 0);
    // At least that of the free pull, at most that of the straight one.
    const Eigen::Matrix3d C = tests::plain_weave();
    const double straight   = 0.5 * C(1, 1) * strain * strain * side * side;
    EXPECT_LT(result.energy, straight);
    EXPECT_GT(result.energy, straight * (1. - std::pow(C(0, 1) / C(0, 0), 2)));
    EXPECT_TRUE(solver.factorize_at(result.positions)); // a minimum
    // There the corotational sheet has none: far beyond T1 = 4 C66 l1 it folds on any such mesh.
    if (strain == 0.05)
    {
      EXPECT_FALSE(corotational.factorize_at(result.positions));
    }
  }
}

TEST(exact_yarn_sheet, a_stiffness_alike_in_all_directions_stays_corotational)
{
  const Membrane alike = sheet_of_yarns(tests::irregular_sheet(2), tests::isotropic(2., 0.3));
  EXPECT_TRUE(alike.yarns.empty());
  // Beside a phase with yarns, too.
  auto mesh        = tests::irregular_sheet(2);
  mesh.material(0) = 1;
  Membrane both    = membrane(mesh, {tests::plain_weave(), tests::isotropic(2., 0.3)});
  take_yarn_law(both);
  const Membrane corotational = membrane(mesh, {tests::plain_weave(), tests::isotropic(2., 0.3)});
  Positions<2> x              = 1.1 * mesh.vertices;
  x.col(0) += 0.2 * mesh.vertices.col(1);
  const auto energy_of_first = [&](Membrane of)
  {
    of.triangles = meshes::Triangles(of.triangles.topRows(1));
    return membrane_energy<2>(of, x);
  };
  EXPECT_EQ(energy_of_first(both), energy_of_first(corotational));
  EXPECT_NE(membrane_energy<2>(both, x), membrane_energy<2>(corotational, x));
}

TEST(invariant_yarn_sheet, a_cubic_energy_beside_yarns_is_refused)
{
  const meshes::TriangleMesh rest =
    meshes::coarse_sheet({0., 0.}, 0.01 * Eigen::Matrix2d::Identity(), 1, 1);
  Membrane sheet = membrane(rest, {Eigen::Vector3d(1e3, 1e3, 1.).asDiagonal().toDenseMatrix()});
  add_cubic_energy(sheet, {meshes::CubicForm()});
  EXPECT_NE(tests::refusal([&]() { take_yarn_law(sheet); }).find("cubic energy beside the law"),
            std::string::npos);
}
