// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "shell/solver/cloth.h"
#include "shell/terms/membrane_term.h"
#include "tests/refusal.h"
#include "tests/shell/shell_cases.h"

#include <gtest/gtest.h>

#include <limits>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::refusal;

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

Positions<2> pulled(const meshes::TriangleMesh &mesh, const int n, const double displacement)
{
  Positions<2> x = mesh.vertices;
  for (int i = 0; i <= n; ++i)
    x(n * (n + 1) + i, 1) += displacement;
  return x;
}

/// The sheet as a cloth in space that lies at `start`, held there at some vertices.
Cloth in_space(const meshes::TriangleMesh &mesh, const Eigen::Matrix3d &stiffness,
               const std::vector<int> &held, const Vectors &start)
{
  meshes::ClothMesh sheet;
  sheet.rest      = mesh;
  sheet.triangles = mesh.triangles;
  sheet.positions = tests::embedded<3>(mesh);
  Cloth cloth(sheet.positions, lumped_masses(sheet, {1.}), held);
  cloth.add(membrane_term(sheet, {stiffness}));
  cloth.set_state(start, Vectors::Zero(start.rows(), 3), 0.);
  return cloth;
}
} // namespace

TEST(exact_equilibrium, patch_test_an_affine_boundary_gives_an_affine_inside)
{
  const meshes::TriangleMesh mesh = tests::irregular_sheet(6);
  Eigen::Matrix2d F;
  F << 1.12, 0.08, -0.05, 0.93;
  Eigen::Matrix<double, 3, 2> F3;
  F3 << 1.12, 0.08, -0.05, 1.03, 0.3, 0.2;
  const Positions<2> affine2 = mesh.vertices * F.transpose();
  const Positions<3> affine3 = mesh.vertices * F3.transpose();
  const auto hold            = tests::outline_of(mesh);
  const MembraneSolver plane(membrane(mesh, {tests::anisotropic()}), hold);
  // The start has the right boundary and a disturbed inside.
  Positions<2> start2 = affine2;
  Positions<3> start3 = affine3;
  std::mt19937 generator(21);
  std::vector<bool> held(static_cast<std::size_t>(mesh.n_vertices()), false);
  for (const int v : hold)
    held[static_cast<std::size_t>(v)] = true;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!held[static_cast<std::size_t>(v)])
    {
      start2.row(v) += 1e-4 * tests::random_matrix<Eigen::RowVector2d>(generator);
      start3.row(v) += 1e-4 * tests::random_matrix<Eigen::RowVector3d>(generator);
    }
  EXPECT_LT((plane.solve_linear(start2) - affine2).cwiseAbs().maxCoeff(), 1e-11 * 0.01);
  const auto in_plane = plane.solve_equilibrium(start2, {1e-13, 50});
  Cloth cloth         = in_space(mesh, tests::anisotropic(), hold, start3);
  cloth.solve_equilibrium(1e-13);
  EXPECT_LT((in_plane.positions - affine2).cwiseAbs().maxCoeff(), 1e-11 * 0.01);
  EXPECT_LT((cloth.positions() - affine3).cwiseAbs().maxCoeff(), 1e-11 * 0.01);
  EXPECT_EQ(in_plane.inverted_triangles, 0);
  EXPECT_EQ(in_plane.residual_history.size(), static_cast<std::size_t>(in_plane.iterations) + 1);
}

TEST(exact_equilibrium, a_strip_free_to_contract_shrinks_by_its_poisson_ratio)
{
  // Uniaxial tension of a square of one stiffness, edges sliding: U = diag(1 − nu e, 1 + e) and the
  // energy ½ E h e² per area, linear in stretch. Sliding edges: hold one vertex below and move the
  // others to where the closed form has them.
  const int n       = 5;
  const double side = 0.01, nu = 0.3, strain = 0.15, young = 2.;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(n, side);
  Positions<2> expected           = mesh.vertices;
  expected.col(0) *= 1. - nu * strain;
  expected.col(1) *= 1. + strain;
  Positions<2> start = expected;
  for (int v = n + 1; v < n * (n + 1); ++v)
    start.row(v) = 0.5 * (expected.row(v) + mesh.vertices.row(v));
  const MembraneSolver solver(membrane(mesh, {tests::isotropic(young, nu)}), two_edges(n));
  const auto result = solver.solve_equilibrium(start);
  EXPECT_LT((result.positions - expected).cwiseAbs().maxCoeff(), 1e-9 * side);
  const double energy = 0.5 * young * strain * strain * side * side;
  EXPECT_NEAR(result.energy, energy, 1e-12 * energy);
}

TEST(exact_equilibrium, loads_on_a_free_edge_stretch_a_strip_by_their_stress)
{
  // Without contraction: C22 = 5 N/m, held below, pulled above with s C22 per length: the stretch
  // is s, in both, because the stress of biot is linear in it.
  const int n         = 4;
  const double strain = 0.2, side = 0.01, C22 = 5.;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(n, side);
  const MembraneSolver solver(
    membrane(mesh, {Eigen::Vector3d(3., C22, 2.).asDiagonal().toDenseMatrix()}), {0, 1, 2, 3, 4});
  Positions<2> loads = Positions<2>::Zero(mesh.n_vertices(), 2), expected = mesh.vertices;
  expected.col(1) *= 1. + strain;
  for (int i = 0; i < n; ++i)
    for (const int v : {n * (n + 1) + i, n * (n + 1) + i + 1})
      loads(v, 1) += 0.5 * C22 * strain * side / n;
  const Positions<2> start = mesh.vertices;
  EXPECT_LT((solver.solve_linear(start, loads) - expected).cwiseAbs().maxCoeff(), 1e-12 * side);
  const Equilibrium found = solver.solve_equilibrium(start, {1e-13, 50}, loads);
  EXPECT_LT((found.positions - expected).cwiseAbs().maxCoeff(), 1e-11 * side);
  EXPECT_NEAR(found.energy, 0.5 * C22 * strain * strain * side * side, 1e-11 * found.energy);
  // Loads on held vertices change nothing.
  loads.row(2) << 7., -3.;
  EXPECT_LT((solver.solve_linear(start, loads) - expected).cwiseAbs().maxCoeff(), 1e-12 * side);
}

TEST(tripwire_equilibrium, loads_that_do_not_fit_are_named)
{
  const meshes::TriangleMesh mesh = tests::irregular_sheet(2);
  const MembraneSolver solver(membrane(mesh, {tests::anisotropic()}), {0, 1});
  const Positions<2> start = mesh.vertices;
  Positions<2> loads       = Positions<2>::Zero(mesh.n_vertices(), 2);
  loads(5, 1)              = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal([&]() { solver.solve_linear(start, loads); }).find("vertex 5: its load"),
            std::string::npos);
  EXPECT_NE(refusal([&]() { solver.solve_equilibrium(start, {}, loads.topRows(3)); })
              .find("loads: has 3 rows; expected 9"),
            std::string::npos);
}

TEST(order_equilibrium, linear_and_nonlinear_displacements_differ_by_strain_squared)
{
  const int n                     = 8;
  const double side               = 0.01;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(n, side);
  const MembraneSolver solver(membrane(mesh, {tests::isotropic(1., 0.4)}), two_edges(n));
  std::vector<double> strains, differences;
  for (double strain = 1e-3; strain < 0.02; strain *= 2.)
  {
    const Positions<2> start = pulled(mesh, n, strain * side);
    strains.push_back(strain);
    differences.push_back(
      (solver.solve_equilibrium(start).positions - solver.solve_linear(start)).norm());
  }
  EXPECT_NEAR(tests::slope(strains, differences), 2., 0.1);
}

TEST(invariant_equilibrium, positions_scale_with_the_unit_of_length_and_ignore_that_of_stiffness)
{
  const int n = 5;
  std::vector<Positions<2>> results;
  for (const auto &[length, stiffness] : std::vector<std::pair<double, double>>{
         {1., 1.}, {1e3, 1.}, {1e-3, 1e9}, {1., 1e-9}, {1., 1e8}})
  {
    meshes::TriangleMesh mesh = tests::irregular_sheet(n);
    mesh.vertices *= length;
    const MembraneSolver solver(membrane(mesh, {stiffness * tests::isotropic(1., 0.3)}),
                                two_edges(n));
    results.push_back(solver.solve_equilibrium(pulled(mesh, n, 1e-3 * length)).positions / length);
  }
  for (const auto &result : results)
    EXPECT_LT((result - results[0]).cwiseAbs().maxCoeff(), 1e-9 * 0.01);
}

TEST(invariant_equilibrium, prescribed_rigid_motions_carry_the_whole_sheet_even_by_180_degrees)
{
  const int n                     = 4;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(n);
  const MembraneSolver solver(membrane(mesh, {tests::isotropic(1., 0.3)}), two_edges(n));
  for (const double angle : {0.5, 3.1415926535897931})
  {
    const Positions<2> turned = mesh.vertices * tests::rotation<2>(angle).transpose();
    const auto result         = solver.solve_equilibrium(turned);
    EXPECT_EQ(result.iterations, 0);
    EXPECT_LT((result.positions - turned).norm(), 1e-15);
  }
}

TEST(bound_equilibrium, bad_starts_end_in_an_equilibrium_or_a_refusal)
{
  const int n                     = 5;
  const double side               = 0.01;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(n, side);
  const MembraneSolver plane(membrane(mesh, {tests::isotropic(1., 0.3)}), two_edges(n));
  std::mt19937 generator(22);
  const auto inside = [&](const auto &change)
  {
    Positions<2> x = pulled(mesh, n, 0.1 * side);
    for (int v = n + 1; v < n * (n + 1); ++v)
      change(x, v);
    return x;
  };
  const std::vector<Positions<2>> starts = {
    inside([&](Positions<2> &x, int v)
           { x.row(v) = side * tests::random_matrix<Eigen::RowVector2d>(generator); }),
    inside([&](Positions<2> &x, int v) { x(v, 1) = 0.; }),             // onto a line
    inside([&](Positions<2> &x, int v) { x.row(v).setZero(); }),       // onto a point
    inside([&](Positions<2> &x, int v) { x.row(v) = -x.row(v); }),     // turned by 180 degrees
    inside([&](Positions<2> &x, int v) { x(v, 0) = side - x(v, 0); }), // mirrored
    inside(
      [&](Positions<2> &x, int v)
      {
        if (v == 12)
          x(v, 0) = 1e6;
      })};
  const auto check = [](const auto &solve, const double energy_of_start, const std::size_t k)
  {
    try
    {
      const auto [positions, energy] = solve();
      EXPECT_TRUE(positions.allFinite()) << k;
      EXPECT_LE(energy, energy_of_start) << k;
    }
    catch (const meshes::NotConverged &stop)
    {
      EXPECT_FALSE(stop.residual_history().empty()) << k;
    }
  };
  for (std::size_t k = 0; k < starts.size(); ++k)
  {
    check(
      [&]()
      {
        const Equilibrium found = plane.solve_equilibrium(starts[k], {1e-10, 200});
        return std::pair(found.positions, found.energy);
      },
      membrane_energy<2>(plane.rest_membrane(), starts[k]), k);
    Vectors lifted       = Vectors::Zero(mesh.n_vertices(), 3);
    lifted.leftCols<2>() = starts[k];
    Cloth space          = in_space(mesh, tests::isotropic(1., 0.3), two_edges(n), lifted);
    check(
      [&]()
      {
        space.solve_equilibrium(1e-10);
        return std::pair(space.positions(), space.stored_energy());
      },
      space.stored_energy(), k);
  }
}

TEST(bound_equilibrium, converges_to_round_off_at_any_strain_contrast_origin_and_tolerance)
{
  const int n = 6;
  for (const double origin : {0., 1e4})
    for (const double strain : {1e-8, 1e-5, 1e-3, 0.1, -0.05})
      for (const double contrast : {1., 1e6})
        for (const double tolerance : {1e-8, 1e-12})
        {
          meshes::TriangleMesh mesh = tests::irregular_sheet(n, 0.2);
          mesh.vertices.array() += origin;
          for (int t = 0; t < mesh.n_triangles(); ++t)
            mesh.material(t) = (t / (2 * n)) % 2;
          const MembraneSolver solver(
            membrane(mesh, {tests::isotropic(1., 0.3), tests::isotropic(contrast, 0.3)}),
            two_edges(n));
          const Positions<2> start = solver.solve_linear(pulled(mesh, n, 0.2 * strain));
          EXPECT_LE(solver.solve_equilibrium(start, {tolerance, 50}).iterations, 8)
            << origin << ' ' << strain << ' ' << contrast << ' ' << tolerance;
        }
}

TEST(exact_equilibrium, in_the_plane_an_inverted_start_unfolds)
{
  const int n                     = 4;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(n);
  const MembraneSolver solver(membrane(mesh, {tests::isotropic(1., 0.3)}), tests::outline_of(mesh));
  Positions<2> start = mesh.vertices;
  start(12, 0) += 0.004; // beyond its neighbours: triangles with det F < 0
  const auto result = solver.solve_equilibrium(start);
  EXPECT_LT((result.positions - mesh.vertices).norm(), 1e-9 * 0.01);
  EXPECT_EQ(result.inverted_triangles, 0);
}

TEST(tripwire_equilibrium, faults_are_named)
{
  const meshes::TriangleMesh mesh = tests::irregular_sheet(3);
  const Eigen::Matrix3d D         = tests::isotropic(1., 0.3);
  const auto expect               = [](const std::string &text, const std::string &part)
  { EXPECT_NE(text.find(part), std::string::npos) << text; };
  expect(refusal([&] { MembraneSolver(membrane(mesh, {D}), {}); }), "held vertices: none is given");
  expect(refusal([&] { MembraneSolver(membrane(mesh, {D}), {99}); }),
         "held vertex 99: does not exist");
  meshes::TriangleMesh apart = mesh;
  apart.vertices.conservativeResize(mesh.n_vertices() + 1, 2);
  apart.vertices.row(mesh.n_vertices()) << 1., 1.;
  expect(refusal([&] { MembraneSolver(membrane(apart, {D}), {0}); }),
         "vertex 16: no triangles connect it to a held vertex");

  const MembraneSolver solver(membrane(mesh, {D}), two_edges(3));
  Positions<2> start = mesh.vertices;
  start(6, 1)        = std::numeric_limits<double>::quiet_NaN();
  expect(refusal([&] { solver.solve_equilibrium(start); }),
         "vertex 6: its start position is not finite");
  EXPECT_NO_THROW(solver.solve_linear(start)); // vertex 6 is free: its row is ignored
  start(0, 0) = std::numeric_limits<double>::infinity();
  expect(refusal([&] { solver.solve_linear(start); }), "held vertex 0: its prescribed position");
  expect(refusal([&] { solver.solve_linear(Positions<2>::Zero(3, 2)); }),
         "has 3 rows; expected 16");
  const MembraneSolver hinged(membrane(mesh, {D}), {0});
  expect(refusal([&] { hinged.solve_linear(mesh.vertices); }), "leave a rigid motion");
  EXPECT_THROW(solver.solve_equilibrium(pulled(mesh, 3, 0.002), {1e-14, 1}), meshes::NotConverged);
}
