// SPDX-License-Identifier: MIT
#include "homogenization/algebra/refined_solution.h"

#include "homogenization/algebra/cholesky_factor.h"
#include "meshes/plain/errors.h"

#include <cmath>
#include <vector>

namespace homespun::homogenization
{
namespace
{
/// A X of a symmetric matrix, whose entries are read once for all columns.
template <int n_columns>
Eigen::MatrixXd product(const Eigen::SparseMatrix<double> &lower_triangle, const Eigen::MatrixXd &X)
{
  using Block      = Eigen::Matrix<double, Eigen::Dynamic, n_columns,
                              n_columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  const Block from = X;
  Block to         = Block::Zero(X.rows(), X.cols());
  for (int column = 0; column < lower_triangle.outerSize(); ++column)
  {
    const Eigen::Matrix<double, 1, n_columns> factors = from.row(column);
    Eigen::Matrix<double, 1, n_columns> sum           = to.row(column);
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower_triangle, column); entry; ++entry)
    {
      sum += entry.value() * from.row(entry.row());
      if (entry.row() != column)
        to.row(entry.row()) += entry.value() * factors;
    }
    to.row(column) = sum;
  }
  return to;
}

Eigen::MatrixXd product(const Eigen::SparseMatrix<double> &lower_triangle, const Eigen::MatrixXd &X)
{
  return X.cols() == 3 ? product<3>(lower_triangle, X) : product<Eigen::Dynamic>(lower_triangle, X);
}
} // namespace

RefinedSolution refined_solution(const Eigen::SparseMatrix<double> &lower_triangle,
                                 const Eigen::MatrixXd &right_hand_sides, const std::string &what)
{
  if (right_hand_sides.rows() == 0) // two linear triangles: all vertices are one
    return {right_hand_sides};
  const CholeskyFactor factor(lower_triangle, what);
  // Conjugate gradients for all loads abreast: factors and matrix are read once for all of them.
  // r.z is the square of the distance to the solution in the energy norm, as far as the factors are
  // those of the matrix.
  const Eigen::Index n_loads = right_hand_sides.cols();
  Eigen::MatrixXd x          = Eigen::MatrixXd::Zero(right_hand_sides.rows(), n_loads);
  Eigen::MatrixXd best = x, direction = x, residual = right_hand_sides;
  Eigen::ArrayXd energy = Eigen::ArrayXd::Zero(n_loads), power = energy, smallest = energy;
  std::vector<double> history;
  RefinedSolution solution;
  constexpr unsigned max_iterations = 100, patience = 2;
  constexpr double enough = 1e-18;
  unsigned since_best     = 0;
  for (unsigned iteration = 0;; ++iteration)
  {
    const Eigen::MatrixXd preconditioned = factor.solve(residual);
    const Eigen::ArrayXd old_power       = power;
    power = residual.cwiseProduct(preconditioned).colwise().sum().transpose().array();
    if (!power.allFinite())
      throw meshes::NotConverged(what + ": the solution is not finite", history);
    if (iteration == 0)
      energy = smallest = power;
    history.push_back((power / (energy > 0.).select(energy, 1.)).abs().maxCoeff());
    ++since_best;
    for (Eigen::Index load = 0; load < n_loads; ++load)
      if (iteration > 0 && std::abs(power(load)) < smallest(load))
      {
        smallest(load) = std::abs(power(load));
        best.col(load) = x.col(load);
        since_best     = 0;
      }
    solution.iterations = iteration;
    if ((smallest <= enough * energy).all() || since_best > patience || iteration == max_iterations)
      break;
    for (Eigen::Index load = 0; load < n_loads; ++load)
    {
      if (!(power(load) > 0.))
        continue;
      const double memory =
        iteration == 0 || !(old_power(load) > 0.) ? 0. : power(load) / old_power(load);
      direction.col(load) = preconditioned.col(load) + memory * direction.col(load);
    }
    const Eigen::MatrixXd image = product(lower_triangle, direction);
    for (Eigen::Index load = 0; load < n_loads; ++load)
    {
      const double curvature = direction.col(load).dot(image.col(load));
      if (power(load) > 0. && curvature > 0.)
        x.col(load) += power(load) / curvature * direction.col(load);
    }
    // The true residual: what a recursion loses to round-off counts here.
    residual = right_hand_sides - product(lower_triangle, x);
  }
  for (Eigen::Index load = 0; load < n_loads; ++load)
    if (energy(load) > 0.)
      solution.excess = std::max(solution.excess, smallest(load) / energy(load));
  if (solution.excess > 1e-3)
    throw meshes::NotConverged(what + ": conjugate gradients do not settle", history);
  solution.values = best;
  return solution;
}
} // namespace homespun::homogenization
