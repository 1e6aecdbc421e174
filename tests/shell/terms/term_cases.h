// SPDX-License-Identifier: MIT
// What every term of a moving cloth is asked: its matrix, its Taylor remainders, its balance.
#pragma once

#include "meshes/plain/symmetric_eigen.h"
#include "shell/algebra/vertex_matrix.h"
#include "shell/terms/term.h"
#include "tests/shell/shell_cases.h"

#include <Eigen/Dense>

#include <limits>
#include <string>

namespace homespun::tests
{
/// A matrix laid out for one term, all vertices free unless said otherwise.
inline shell::BlockMatrix matrix_for(shell::Term &term, const int n_vertices,
                                     std::vector<bool> is_held = {})
{
  std::vector<std::array<int, 2>> pairs;
  const int n_nodes = term.take_nodes(n_vertices);
  term.couple(pairs);
  is_held.resize(static_cast<std::size_t>(n_vertices + n_nodes), false);
  shell::BlockMatrix matrix(pairs, is_held);
  term.attach(matrix);
  return matrix;
}

inline shell::Vectors gradient_of(const shell::Term &term, const shell::Vectors &x)
{
  shell::Vectors gradient = shell::Vectors::Zero(x.rows(), 3);
  term.add_gradient(x, gradient);
  return gradient;
}

/// What a term does over a step of the conserving integrator.
inline shell::Vectors discrete_gradient(const shell::Term &term, const shell::Vectors &before,
                                        const shell::Vectors &after)
{
  shell::Vectors gradient = shell::Vectors::Zero(before.rows(), 3);
  shell::VertexMatrix jacobian(std::vector<bool>(static_cast<std::size_t>(before.rows()), false));
  term.add_discrete_gradient(before, after, gradient, jacobian);
  return gradient;
}

/// All entries, vertex by vertex (3 n, 3 n); zero rows and columns for held vertices.
inline Eigen::MatrixXd dense(const shell::BlockMatrix &matrix)
{
  const int n = matrix.n_vertices();
  Eigen::MatrixXd all(3 * n, 3 * n);
  shell::Vectors x(n, 3), y;
  for (int c = 0; c < 3 * n; ++c)
  {
    x.setZero();
    if (matrix.is_free(c / 3))
      x(c / 3, c % 3) = 1.;
    matrix.multiply(x, y);
    all.col(c) = Eigen::Map<const Eigen::VectorXd>(y.data(), 3 * n);
  }
  return all;
}

/// The same of the vertices alone, a term's nodes eliminated.
inline Eigen::MatrixXd dense(const shell::BlockMatrix &matrix, const Eigen::Index n_vertices)
{
  const Eigen::MatrixXd all = dense(matrix);
  const Eigen::Index n = 3 * n_vertices, rest = all.rows() - n;
  if (rest == 0)
    return all;
  return all.topLeftCorner(n, n) -
         all.topRightCorner(n, rest) *
           all.bottomRightCorner(rest, rest).ldlt().solve(all.bottomLeftCorner(rest, n));
}

inline Eigen::Vector3d torque(const shell::Vectors &x, const shell::Vectors &forces)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    sum += Eigen::Vector3d(x.row(v)).cross(Eigen::Vector3d(forces.row(v)));
  return sum;
}

/// Remainders of energy, gradient and Hessian along a direction, halving the step.
struct TaylorOrders
{
  double gradient = 0., hessian = 0.;
};
inline TaylorOrders taylor_orders(shell::Term &term, const shell::Vectors &x,
                                  const shell::Vectors &direction)
{
  shell::BlockMatrix matrix = matrix_for(term, static_cast<int>(x.rows()));
  shell::Vectors gradient   = shell::Vectors::Zero(x.rows(), 3);
  term.add_derivatives(x, shell::Hessian::exact, gradient, matrix);
  const Eigen::Map<const Eigen::VectorXd> along(direction.data(), direction.size());
  const double value = term.energy(x), first = gradient.cwiseProduct(direction).sum(),
               second = along.dot(dense(matrix, x.rows()) * along);
  std::vector<double> steps, two, three;
  for (double h = 1. / 16.; h > 2e-3; h *= 0.5)
  {
    const double remainder = term.energy(x + h * direction) - value - h * first;
    steps.push_back(h);
    two.push_back(std::abs(remainder));
    three.push_back(std::abs(remainder - 0.5 * h * h * second));
  }
  return {slope(steps, two), slope(steps, three)};
}

/// Smallest over largest eigenvalue.
inline double smallest_eigenvalue_ratio(const shell::BlockMatrix &matrix)
{
  const Eigen::VectorXd modes = meshes::symmetric_eigen<Eigen::Dynamic>(dense(matrix)).values;
  return modes.minCoeff() / modes.cwiseAbs().maxCoeff();
}
} // namespace homespun::tests
