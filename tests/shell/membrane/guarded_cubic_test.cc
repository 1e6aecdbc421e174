// SPDX-License-Identifier: MIT
#include "shell/membrane/guarded_cubic.h"
#include "shell/solver/equilibrium.h"
#include "shell/terms/membrane_term.h"
#include "tests/refusal.h"
#include "tests/shell/shell_cases.h"
#include "tests/shell/terms/term_cases.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::shell;

namespace
{
/// A cubic form as large beside a stiffness as a cell's may be.
meshes::CubicForm some_form(std::mt19937 &generator, const Eigen::Matrix3d &D)
{
  meshes::CubicForm form;
  form.derivatives =
    2. * D.diagonal().minCoeff() * tests::random_matrix<Eigen::Matrix<double, 10, 1>>(generator);
  return form;
}

/// A strain of the given part of the reach of a form.
Eigen::Vector3d strain_at(const double part, const GuardedCubic &cubic, const Eigen::Matrix3d &D,
                          std::mt19937 &generator)
{
  const auto direction = tests::random_matrix<Eigen::Vector3d>(generator);
  return part * cubic.reach() / std::sqrt(direction.dot(D * direction)) * direction;
}

/// The least part of the stiffness that a strain keeps.
double softest(const GuardedCubic &cubic, const Eigen::Matrix3d &D, const Eigen::Vector3d &strain)
{
  const Eigen::Matrix3d second = D + cubic.hessian(strain);
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(second, D).eigenvalues()(0);
}

const std::array<double, 5> parts = {0.5, 1.2, 1.45, 2.5, 20.}; ///< of all three pieces
} // namespace

TEST(exact_guarded_cubic, it_is_the_cubic_form_itself_within_its_reach)
{
  std::mt19937 generator(1);
  for (const Eigen::Matrix3d &D : {tests::isotropic(2., 0.3), tests::anisotropic()})
  {
    const meshes::CubicForm form = some_form(generator, D);
    const GuardedCubic cubic(form, D);
    for (int k = 0; k < 20; ++k)
    {
      const Eigen::Vector3d e = strain_at(0.999, cubic, D, generator);
      EXPECT_TRUE(cubic.is_trusted(e));
      EXPECT_EQ(cubic.value(e), form.value(e));
      EXPECT_EQ(cubic.gradient(e), form.gradient(e));
      EXPECT_EQ(cubic.hessian(e), form.hessian(e));
      EXPECT_FALSE(cubic.is_trusted(1.01 * e));
    }
  }
  const GuardedCubic none(meshes::CubicForm(), tests::anisotropic());
  EXPECT_EQ(none.reach(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(none.value({1e3, -2e3, 5.}), 0.);
}

// Summed over forms, strains and directions: of a single one the leading term may vanish.
TEST(derivative_guarded_cubic, taylor_remainders_are_of_second_and_third_order)
{
  std::mt19937 generator(2);
  for (const Eigen::Matrix3d &D : {tests::isotropic(2., 0.3), tests::anisotropic()})
    for (const double part : parts)
    {
      std::vector<double> steps, first, second;
      for (double h = 1. / 32.; h > 1e-3; h *= 0.5)
        steps.push_back(h);
      first.assign(steps.size(), 0.);
      second = first;
      for (int k = 0; k < 20; ++k)
      {
        const GuardedCubic cubic(some_form(generator, D), D);
        const Eigen::Vector3d e = strain_at(part, cubic, D, generator),
                              d = strain_at(0.3 * part, cubic, D, generator);
        const double size       = cubic.reach() * cubic.reach();
        for (std::size_t i = 0; i < steps.size(); ++i)
        {
          const double h = steps[i];
          const double remainder =
            (cubic.value(e + h * d) - cubic.value(e) - h * cubic.gradient(e).dot(d)) / size;
          first[i] += std::abs(remainder);
          second[i] += std::abs(remainder - 0.5 * h * h * d.dot(cubic.hessian(e) * d) / size);
        }
      }
      EXPECT_NEAR(tests::slope(steps, first), 2., 0.1) << part;
      EXPECT_NEAR(tests::slope(steps, second), 3., 0.1) << part;
    }
}

TEST(derivative_guarded_cubic, value_gradient_and_hessian_are_continuous_where_pieces_meet)
{
  std::mt19937 generator(3);
  const Eigen::Matrix3d D = tests::anisotropic();
  const GuardedCubic cubic(some_form(generator, D), D);
  for (const double part : {1., 1.5})
    for (int k = 0; k < 10; ++k)
    {
      const Eigen::Vector3d e     = strain_at(part, cubic, D, generator);
      const Eigen::Vector3d below = (1. - 1e-9) * e, above = (1. + 1e-9) * e;
      // The third derivative is some ten times C/|e| at most: 2e-9 of |e| change the second by
      // this.
      EXPECT_NEAR(cubic.value(below), cubic.value(above), 1e-7 * e.dot(D * e));
      EXPECT_LT((cubic.gradient(below) - cubic.gradient(above)).norm(), 1e-7 * D.norm() * e.norm());
      EXPECT_LT((cubic.hessian(below) - cubic.hessian(above)).norm(), 1e-7 * D.norm());
    }
}

// 0.1 is what the bound in the header leaves, for any form.
TEST(bound_guarded_cubic, every_strain_keeps_a_tenth_of_the_stiffness)
{
  std::mt19937 generator(4);
  double least = 1.;
  for (int k = 0; k < 400; ++k)
  {
    const Eigen::Matrix3d D = k % 2 ? tests::anisotropic() : tests::isotropic(2., 0.3);
    meshes::CubicForm form  = some_form(generator, D);
    if (k % 4 == 0) // one or few of the ten numbers
      for (Eigen::Index i = 0; i < 10; ++i)
        if (i != k / 4 % 10)
          form.derivatives(i) = 0.;
    const GuardedCubic cubic(form, D);
    for (int i = 1; i <= 60; ++i)
      least = std::min(least, softest(cubic, D, strain_at(0.05 * i, cubic, D, generator)));
    for (const double part : {1e2, 1e4, 1e8})
      EXPECT_GT(softest(cubic, D, strain_at(part, cubic, D, generator)), 0.9);
  }
  EXPECT_GE(least, 0.1);
  EXPECT_LT(least, 0.6) << "the guard is tried where it works";
}

TEST(bound_guarded_cubic, the_reach_is_that_of_the_largest_value_on_the_unit_sphere)
{
  meshes::CubicForm form; // x³ − 3 x y²: its third derivative is 6 on unit strains
  form.derivatives(0)     = 6.;
  form.derivatives(3)     = -6.;
  const Eigen::Matrix3d D = Eigen::Matrix3d::Identity();
  const GuardedCubic cubic(form, D);
  EXPECT_NEAR(cubic.reach(), 1. / 18., 0.03 / 18.); // the net of the sphere bounds from above
  EXPECT_LE(cubic.reach(), 1. / 18.);
}

template <int dim>
void expect_taylor_orders_of_the_membrane()
{
  std::mt19937 generator(5);
  const meshes::TriangleMesh mesh = tests::irregular_sheet(3);
  const Eigen::Matrix3d D         = tests::isotropic(2., 0.3);
  Membrane whole                  = membrane(mesh, {D});
  add_cubic_energy(whole, {some_form(generator, D)});
  // Beside the small-strain case one beyond the reach of the cubic.
  for (const double stretch : {1.05, 1.6})
  {
    Positions<dim> x = stretch * tests::embedded<dim>(mesh);
    x += 5e-4 * tests::random_matrix<Positions<dim>>(generator, x.rows(), dim);
    const Positions<dim> d = 1e-3 * tests::random_matrix<Positions<dim>>(generator, x.rows(), dim);
    const Positions<dim> change = tests::hessian_times<dim>(whole, x, d);
    const double slope_along    = membrane_gradient<dim>(whole, x).gradient.cwiseProduct(d).sum();
    std::vector<double> steps, first, of_gradient;
    for (double h = 1. / 64.; h > 6e-4; h *= 0.5)
    {
      const Positions<dim> moved = x + h * d;
      steps.push_back(h);
      first.push_back(std::abs(membrane_energy<dim>(whole, moved) - membrane_energy<dim>(whole, x) -
                               h * slope_along));
      of_gradient.push_back((membrane_gradient<dim>(whole, moved).gradient -
                             membrane_gradient<dim>(whole, x).gradient - h * change)
                              .norm());
    }
    EXPECT_NEAR(tests::slope(steps, first), 2., 0.1);
    EXPECT_NEAR(tests::slope(steps, of_gradient), 2., 0.1);
  }
}

TEST(derivative_membrane_with_cubic_energy, taylor_remainders_have_their_orders)
{
  expect_taylor_orders_of_the_membrane<2>();
  expect_taylor_orders_of_the_membrane<3>();
}

TEST(exact_membrane_with_cubic_energy, the_term_of_a_moving_cloth_has_the_same_energy_and_forces)
{
  std::mt19937 generator(6);
  const meshes::TriangleMesh mesh = tests::irregular_sheet(3);
  const Eigen::Matrix3d D         = tests::isotropic(2., 0.3);
  const meshes::CubicForm form    = some_form(generator, D);
  Membrane whole                  = membrane(mesh, {D});
  add_cubic_energy(whole, {form});
  meshes::ClothMesh cloth;
  cloth.positions = tests::embedded<3>(mesh);
  cloth.triangles = mesh.triangles;
  cloth.rest      = mesh;
  const auto term = membrane_term(cloth, {D}, 0., {form});
  Vectors x       = 1.1 * tests::embedded<3>(mesh);
  x += 5e-4 * tests::random_matrix<Vectors>(generator, x.rows(), 3);
  Vectors gradient = Vectors::Zero(x.rows(), 3);
  term->add_gradient(x, gradient);
  const double energy = membrane_energy<3>(whole, x);
  EXPECT_NEAR(term->energy(x), energy, 1e-13 * energy);
  EXPECT_NEAR(term->stored_energy(x), energy, 1e-13 * energy);
  EXPECT_LT((gradient - membrane_gradient<3>(whole, x).gradient).norm(), 1e-13 * gradient.norm());
  for (const Hessian kind : {Hessian::exact, Hessian::projected})
  {
    BlockMatrix matrix = tests::matrix_for(*term, static_cast<int>(x.rows()));
    Vectors again      = Vectors::Zero(x.rows(), 3);
    term->add_derivatives(x, kind, again, matrix);
    EXPECT_LT((again - gradient).norm(), 1e-13 * gradient.norm());
    Eigen::MatrixXd known = Eigen::MatrixXd::Zero(3 * x.rows(), 3 * x.rows());
    for (int t = 0; t < mesh.n_triangles(); ++t)
    {
      const auto of = membrane_hessian<3>(whole, t, x, kind);
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          known.block<3, 3>(3 * mesh.triangles(t, k), 3 * mesh.triangles(t, l)) +=
            of.block<3, 3>(3 * k, 3 * l);
    }
    EXPECT_LT((tests::dense(matrix) - known).norm(), 1e-12 * known.norm());
  }
  EXPECT_FALSE(term->has_discrete_gradient());
  EXPECT_EQ(term->name(), "cubic membrane");
}

TEST(invariant_membrane_with_cubic_energy, faults_are_named)
{
  Membrane whole = membrane(tests::irregular_sheet(3), {tests::isotropic(2., 0.3)});
  EXPECT_NE(tests::refusal([&]() { add_cubic_energy(whole, std::vector<meshes::CubicForm>(2)); })
              .find("found 2; expected one for each of 1 phases"),
            std::string::npos);
  meshes::CubicForm form;
  form.derivatives(4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(tests::refusal([&]() { add_cubic_energy(whole, {form}); }).find("is not finite"),
            std::string::npos);
}

TEST(exact_membrane_with_cubic_energy, a_sheet_pulled_evenly_has_the_stress_of_its_energy)
{
  // Held all around: the affine motion is the equilibrium, and Newton's method stays there.
  std::mt19937 generator(7);
  const meshes::TriangleMesh mesh = tests::irregular_sheet(4);
  const Eigen::Matrix3d D         = tests::isotropic(2., 0.3);
  Membrane cubic                  = membrane(mesh, {D});
  add_cubic_energy(cubic, {some_form(generator, D)});
  const MembraneSolver solver(cubic, tests::outline_of(mesh));
  Eigen::Matrix2d U;
  U << 1.05, 0.02, 0.02, 0.97;
  const Positions<2> even     = mesh.vertices * U;
  Positions<2> start          = even;
  const std::vector<int> held = tests::outline_of(mesh);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (std::find(held.begin(), held.end(), v) == held.end())
      start.row(v) += 2e-4 * tests::random_matrix<Eigen::RowVector2d>(generator);
  const Equilibrium found = solver.solve_equilibrium(start);
  EXPECT_LT((found.positions - even).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE(found.iterations, 8);
}
