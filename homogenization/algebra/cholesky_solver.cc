// SPDX-License-Identifier: MIT
#include "homogenization/algebra/cholesky_solver.h"

#include "meshes/plain/errors.h"

#include <cmath>
#include <vector>

namespace homespun::homogenization
{
CholeskySolver::CholeskySolver(const Eigen::SparseMatrix<double> &lower_triangle,
                               const std::string &what)
    : what(what)
    , matrix(lower_triangle)
    , factor(lower_triangle, what)
{
}

CholeskySolver::Solution CholeskySolver::solve(const Eigen::MatrixXd &right_hand_sides) const
{
  // Conjugate gradients for all loads abreast: the factors are read once for all of them. r.z is
  // the square of the distance to the solution in the energy norm, as far as the factors are those
  // of the matrix.
  const auto whole           = matrix.selfadjointView<Eigen::Lower>();
  const Eigen::Index n_loads = right_hand_sides.cols();
  Eigen::MatrixXd x          = Eigen::MatrixXd::Zero(right_hand_sides.rows(), n_loads);
  Eigen::MatrixXd best = x, direction = x, residual = right_hand_sides;
  Eigen::ArrayXd energy = Eigen::ArrayXd::Zero(n_loads), product = energy, smallest = energy;
  std::vector<double> history;
  Solution solution;
  constexpr unsigned max_iterations = 100, patience = 2;
  constexpr double enough = 1e-18;
  unsigned since_best     = 0;
  for (unsigned iteration = 0;; ++iteration)
  {
    const Eigen::MatrixXd preconditioned = factor.solve(residual);
    const Eigen::ArrayXd old_product     = product;
    product = residual.cwiseProduct(preconditioned).colwise().sum().transpose().array();
    if (!product.allFinite())
      throw meshes::NotConverged(what + ": the solution is not finite", history);
    if (iteration == 0)
      energy = smallest = product;
    history.push_back((product / (energy > 0.).select(energy, 1.)).abs().maxCoeff());
    ++since_best;
    for (Eigen::Index load = 0; load < n_loads; ++load)
      if (iteration > 0 && std::abs(product(load)) < smallest(load))
      {
        smallest(load) = std::abs(product(load));
        best.col(load) = x.col(load);
        since_best     = 0;
      }
    solution.iterations = iteration;
    if ((smallest <= enough * energy).all() || since_best > patience || iteration == max_iterations)
      break;
    for (Eigen::Index load = 0; load < n_loads; ++load)
    {
      if (!(product(load) > 0.))
        continue;
      const double memory =
        iteration == 0 || !(old_product(load) > 0.) ? 0. : product(load) / old_product(load);
      direction.col(load)         = preconditioned.col(load) + memory * direction.col(load);
      const Eigen::VectorXd image = whole * direction.col(load);
      const double curvature      = direction.col(load).dot(image);
      if (curvature > 0.)
        x.col(load) += product(load) / curvature * direction.col(load);
      // The true residual: what a recursion loses to round-off counts here.
      residual.col(load) = right_hand_sides.col(load) - whole * x.col(load);
    }
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
