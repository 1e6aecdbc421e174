// SPDX-License-Identifier: MIT
// The tension of a selvedge: derivatives, balance, energy, and when it is well posed.
#include "meshes/plain/symmetric_eigen.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/selvedge.h"
#include "tests/refusal.h"
#include "tests/shell/solver/cloth_cases.h"
#include "tests/shell/terms/term_cases.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::shell;
using namespace homespun::tests;

namespace
{
constexpr int n = 4;

/// Cables on all four edges of lying_sheet(n).
std::vector<SelvedgeSegment> all_around(const meshes::ClothMesh &mesh, const double stiffness)
{
  std::vector<SelvedgeSegment> segments;
  const auto add = [&](const int a, const int b)
  {
    segments.push_back({{a, b}, (mesh.positions.row(b) - mesh.positions.row(a)).norm(), stiffness});
  };
  for (int k = 0; k < n; ++k)
    for (const int end : {0, n})
    {
      add(end * (n + 1) + k, end * (n + 1) + k + 1);
      add(k * (n + 1) + end, (k + 1) * (n + 1) + end);
    }
  return segments;
}

Vectors shaken(const meshes::ClothMesh &mesh, const double size)
{
  std::mt19937 generator(3);
  return mesh.positions + size * random_matrix<Vectors>(generator, mesh.positions.rows(), 3);
}
} // namespace

TEST(derivative_selvedge, gradient_and_hessian_are_those_of_the_energy)
{
  const meshes::ClothMesh mesh = lying_sheet(n);
  for (const double kappa : {2., -2.})
  {
    const auto term       = selvedge_term(all_around(mesh, kappa));
    const Vectors x       = shaken(mesh, 0.02);
    const TaylorOrders of = taylor_orders(*term, x, 0.1 * (shaken(mesh, 0.03) - mesh.positions));
    EXPECT_NEAR(of.gradient, 2., 0.1);
    EXPECT_NEAR(of.hessian, 3., 0.1);
  }
}

TEST(invariant_selvedge, it_has_no_force_as_a_whole_and_none_in_rigid_motion)
{
  const meshes::ClothMesh mesh = lying_sheet(n);
  const auto term              = selvedge_term(all_around(mesh, -3.));
  const Vectors turned         = mesh.positions * rotation<3>(2.).transpose();
  EXPECT_LT(gradient_of(*term, turned).cwiseAbs().maxCoeff(), 1e-13);
  const Vectors x = shaken(mesh, 0.02), forces = gradient_of(*term, x);
  EXPECT_LT(forces.colwise().sum().norm(), 1e-13 * forces.norm());
  EXPECT_LT(torque(x, forces).norm(), 1e-13 * forces.norm());
}

TEST(bound_selvedge, its_projected_hessian_is_positive_semi_definite)
{
  const meshes::ClothMesh mesh = lying_sheet(n);
  for (const double kappa : {2., -2.})
  {
    const auto term    = selvedge_term(all_around(mesh, kappa));
    BlockMatrix matrix = matrix_for(*term, static_cast<int>(mesh.positions.rows()));
    Vectors gradient   = Vectors::Zero(mesh.positions.rows(), 3);
    term->add_derivatives(shaken(mesh, 0.02), Hessian::projected, gradient, matrix);
    EXPECT_GT(smallest_eigenvalue_ratio(matrix), -1e-12) << kappa;
  }
}

// Stretched alike, a cable pulls with kappa e at its ends and not between them.
TEST(exact_selvedge, a_cable_pulls_at_its_ends_with_kappa_times_the_strain)
{
  const meshes::ClothMesh mesh = lying_sheet(n);
  std::vector<SelvedgeSegment> row;
  for (int k = 0; k < n; ++k)
    row.push_back({{k, k + 1}, (mesh.positions.row(k + 1) - mesh.positions.row(k)).norm(), -0.7});
  const auto term = selvedge_term(row);
  Vectors x       = mesh.positions;
  x.col(0) *= 1.03;
  const Vectors gradient = gradient_of(*term, x);
  EXPECT_NEAR(gradient(0, 0), 0.7 * 0.03, 1e-14);
  EXPECT_NEAR(gradient(n, 0), -0.7 * 0.03, 1e-14);
  EXPECT_LT(gradient.middleRows(1, n - 1).cwiseAbs().maxCoeff(), 1e-14);
}

// Isotropic cloth: without traction across, e_22 = −nu e_11, so kappa = T_11 − nu T_22; turned by
// any angle alike.
TEST(exact_selvedge, kappa_takes_the_strains_of_an_edge_without_traction)
{
  constexpr double nu     = 0.3;
  const Eigen::Matrix3d C = isotropic(5., nu);
  EXPECT_NEAR(selvedge_stiffness({2., 0.5, 0.1}, C, {3., 0.}), 2. - nu * 0.5, 1e-14);
  EXPECT_NEAR(selvedge_stiffness({2., 0.5, 0.1}, C, {0., -1.}), 0.5 - nu * 2., 1e-14);
  // Along a diagonal e_11 = e_22 = (1 − nu)/2 and gamma = 1 + nu.
  EXPECT_NEAR(selvedge_stiffness({2., 0.5, 0.1}, C, {1., 1.}),
              0.5 * (1. - nu) * 2.5 + (1. + nu) * 0.1, 1e-14);
}

// The conserving integrator keeps energy and both momenta with it, of either sign.
TEST(exact_selvedge, a_free_sheet_keeps_energy_and_momenta)
{
  const meshes::ClothMesh mesh = lying_sheet(n);
  const Eigen::VectorXd masses = lumped_masses(mesh, {0.2});
  const Eigen::Matrix3d C      = isotropic(100., 0.3);
  const double height          = (mesh.positions.row(1) - mesh.positions.row(0)).norm(),
               most            = largest_push(C, {1., 0.}, height);
  for (const double kappa : {0.8 * most, -0.8 * most})
  {
    ClothOptions options;
    options.integrator = Integrator::conserving;
    Cloth cloth(mesh.positions, masses, {}, options);
    cloth.add(membrane_term(mesh, {C}));
    cloth.add(selvedge_term(all_around(mesh, kappa)));
    Vectors velocities = Vectors::Zero(mesh.positions.rows(), 3);
    for (Eigen::Index v = 0; v < velocities.rows(); ++v)
      velocities.row(v) << 4. * mesh.positions(v, 0), 2. * mesh.positions(v, 0), 1.;
    cloth.set_state(mesh.positions, velocities, 0.);
    const double energy               = cloth.kinetic_energy() + cloth.stored_energy();
    const Eigen::RowVector3d momentum = cloth.momentum(), spin = cloth.angular_momentum();
    double most_stored = 0.;
    for (int step = 0; step < 50; ++step)
    {
      cloth.step(0.002);
      most_stored = std::max(most_stored, cloth.stored_energy());
    }
    EXPECT_GT(most_stored, 1e-3 * energy);
    EXPECT_NEAR(cloth.kinetic_energy() + cloth.stored_energy(), energy, 1e-9 * energy) << kappa;
    EXPECT_LT((cloth.momentum() - momentum).norm(), 1e-9 * momentum.norm());
    EXPECT_LT((cloth.angular_momentum() - spin).norm(), 1e-9 * spin.norm());
  }
}

// Up to largest_push() a stretched sheet is a strict minimum; the triangles behind the edge say so.
TEST(bound_selvedge, a_cable_that_pushes_less_than_the_triangles_bear_leaves_a_minimum)
{
  const meshes::ClothMesh mesh = lying_sheet(n);
  const Eigen::Matrix3d C      = isotropic(100., 0.3);
  const double most =
    largest_push(C, {1., 0.}, (mesh.positions.row(1) - mesh.positions.row(0)).norm());
  const auto smallest = [&](const double kappa)
  {
    std::vector<SelvedgeSegment> row;
    for (int k = 0; k < n; ++k)
      row.push_back(
        {{k, k + 1}, (mesh.positions.row(k + 1) - mesh.positions.row(k)).norm(), kappa});
    const auto membrane = membrane_term(mesh, {C}), selvedge = selvedge_term(row);
    Vectors gradient = Vectors::Zero(mesh.positions.rows(), 3), x = mesh.positions;
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * x.rows(), 3 * x.rows());
    for (Term *term : {membrane.get(), selvedge.get()})
    {
      BlockMatrix matrix = matrix_for(*term, static_cast<int>(x.rows()));
      term->add_derivatives(x, Hessian::exact, gradient, matrix);
      sum += dense(matrix);
    }
    return meshes::symmetric_eigen<Eigen::Dynamic>(sum).values(0) / C.norm();
  };
  EXPECT_GT(smallest(-0.99 * most), -1e-12);
  EXPECT_LT(smallest(-4. * most), -1e-3);
}

TEST(tripwire_selvedge, a_segment_without_length_is_named)
{
  EXPECT_NE(refusal(
              [] {
                selvedge_term({{{0, 1}, 0.1, 1.}, {{1, 2}, 0., 1.}});
              })
              .find("selvedge: segment 1 has length 0"),
            std::string::npos);
}
