// SPDX-License-Identifier: MIT
#include "homogenization/fem/kept_preconditioner.h"
#include "tests/meshes/plain/shapes.h"

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
/// Laplace's operator of each component on a square whose boundary is held, solved to ten digits.
class Held
{
public:
  using Vector = ElasticSolver::Vector;

  Held()
      : discretization(tests::parallelogram(tests::square_lattice(1.), 12, 12), 1, MPI_COMM_SELF)
  {
    constraints.reinit(discretization.locally_active);
    for (const Node &node : discretization.boundary_nodes())
      for (const auto dof : {node.first_dof, node.second_dof})
        constraints.add_line(dof);
    constraints.close();
    solver = std::make_unique<ElasticSolver>(discretization, constraints);
    answer = solver->owned_vector();
  }

  /// −Laplace's operator minus `shift`, times a factor of each triangle.
  void assemble(
    const double shift,
    const std::function<double(unsigned int)> &factor = [](unsigned int) { return 1.; })
  {
    unsigned int triangle = 0;
    solver->matrix        = 0.;
    auto fe_values        = discretization.fe_values(discretization.stiffness_quadrature);
    dealii::FullMatrix<double> of_triangle(6, 6);
    discretization.for_owned_cells(
      [&](const auto &cell, const std::vector<dealii::types::global_dof_index> &dofs)
      {
        fe_values.reinit(cell);
        const double area = fe_values.JxW(0);
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
          {
            const double mass = shift * area / (i == j ? 6. : 12.);
            of_triangle(i, j) =
              i % 2 == j % 2
                ? area * (fe_values.shape_grad(i, 0) * fe_values.shape_grad(j, 0)) - mass
                : 0.;
          }
        of_triangle *= factor(triangle++);
        constraints.distribute_local_to_global(of_triangle, dofs, solver->matrix);
      });
    solver->matrix.compress(dealii::VectorOperation::add);
  }

  Vector forces() const
  {
    Vector all = solver->owned_vector();
    for (const auto dof : discretization.locally_owned)
      all(dof) = constraints.is_constrained(dof) ? 0. : 1. + dof % 7;
    all.compress(dealii::VectorOperation::insert);
    return all;
  }

  /// @return iterations
  unsigned int solve(const unsigned int most_iterations = 100)
  {
    return kept.solve(*solver, answer, forces(), 1e-10 * forces().l2_norm(), most_iterations);
  }

  double residual() const
  {
    Vector image(answer);
    solver->matrix.vmult(image, answer);
    image -= forces();
    return image.l2_norm() / forces().l2_norm();
  }

  const Discretization discretization;
  dealii::AffineConstraints<double> constraints;
  std::unique_ptr<ElasticSolver> solver;
  KeptPreconditioner kept;
  Vector answer;
};
} // namespace

// A new factor takes one iteration; kept for a matrix that is up to 1.4 times as stiff, where the
// condition is 1.4 and conjugate gradients gain a factor of 12 with each, ten digits take some ten.
TEST(bound_kept_preconditioner, a_factor_of_a_nearby_matrix_takes_few_iterations)
{
  Held held;
  ASSERT_TRUE(held.solver->is_small());
  held.assemble(0.);
  EXPECT_LE(held.solve(), 2u);
  EXPECT_LE(held.residual(), 1.1e-10);
  held.assemble(-8.); // the smallest eigenvalue is 2 pi^2
  const unsigned int used = held.solve();
  EXPECT_LE(held.residual(), 1.1e-10);
  EXPECT_GT(used, 2u); // of the factor of another matrix
  EXPECT_LE(used, 12u);
}

// Triangles that are up to a million times as stiff as before: conjugate gradients with the old
// factor take more than three dozen iterations, and as long as a factorization. One that was asked
// for, of the projected tangent of a state for the exact one of the same, is used whatever it
// takes.
TEST(bound_kept_preconditioner, a_factor_of_a_distant_matrix_is_given_up_unless_it_was_asked_for)
{
  for (const bool was_asked_for : {false, true})
  {
    Held held;
    held.assemble(0.);
    held.kept.build(*held.solver);
    if (!was_asked_for)
      held.solve(1000);
    held.assemble(0., [](const unsigned int triangle) { return std::pow(10., triangle % 7); });
    const unsigned int used = held.solve(1000);
    EXPECT_LE(held.residual(), 1.1e-10);
    if (was_asked_for)
      EXPECT_GT(used, 36u);
    else
      EXPECT_LE(used, 2u);
  }
}

// A factor that served many solves cheaply is made anew once a solve costs more than their mean,
// its making included, and serves as long as each costs the same.
TEST(exact_kept_preconditioner, a_factor_is_made_anew_where_that_lowers_the_mean_cost)
{
  for (const bool was_cheap : {true, false})
  {
    Held held;
    held.assemble(0.);
    for (int k = 0; k < (was_cheap ? 20 : 1); ++k)
      EXPECT_LE(held.solve(), 2u);
    held.assemble(-8.);
    const unsigned int with_old = held.solve(), then = held.solve();
    EXPECT_GT(with_old, 2u); // 20 cheap ones: x > (8 + 40 + x) / 21 from 3 on
    EXPECT_LE(with_old, 9u); // one: x <= (8 + 1 + x) / 2
    if (was_cheap)
      EXPECT_LE(then, 2u);
    else
      EXPECT_EQ(then, with_old);
  }
}

// With the factor of a definite matrix conjugate gradients tell the direction. One of its own has
// none, and a hierarchy may not be definite either; the next call begins anew.
TEST(exact_kept_preconditioner, an_indefinite_matrix_is_not_solved)
{
  for (const bool has_factor_of_another : {false, true})
  {
    Held held;
    if (has_factor_of_another)
    {
      held.assemble(0.);
      held.solve();
    }
    held.assemble(30.); // between the first two eigenvalues, 2 pi^2 and 5 pi^2
    try
    {
      held.solve();
      FAIL() << "a matrix that is not definite was solved with";
    }
    catch (const IndefiniteMatrix &found)
    {
      ElasticSolver::Vector image(found.direction);
      held.solver->matrix.vmult(image, found.direction);
      EXPECT_LT(found.direction * image, 0.);
    }
    catch (const meshes::NotConverged &)
    {
      EXPECT_FALSE(has_factor_of_another);
    }
    held.assemble(0.);
    EXPECT_LE(held.solve(), 2u);
    EXPECT_LE(held.residual(), 1.1e-10);
  }
}
