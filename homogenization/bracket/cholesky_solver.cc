// SPDX-License-Identifier: MIT
#include "homogenization/bracket/cholesky_solver.h"

#include "meshes/plain/errors.h"

#include <Eigen/CholmodSupport>

#include <cmath>
#include <vector>

namespace homespun::homogenization
{
struct CholeskySolver::Factorization
{
  Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower> of_cholmod;
};

CholeskySolver::CholeskySolver(const Eigen::SparseMatrix<double> &lower_triangle,
                               const std::string &what)
    : what(what)
    , scale(lower_triangle.diagonal())
    , scaled(lower_triangle)
    , factorization(std::make_unique<Factorization>())
{
  for (double &entry : scale)
  {
    if (!(entry > 0.) || !std::isfinite(entry))
      throw meshes::NotConverged(what + ": a degree of freedom has no stiffness", {});
    entry = 1. / std::sqrt(entry);
  }
  for (int column = 0; column < scaled.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(scaled, column); entry; ++entry)
      entry.valueRef() *= scale(entry.row()) * scale(column);

  auto &cholmod           = factorization->of_cholmod;
  cholmod.cholmod().print = 0;
  cholmod.setMode(Eigen::CholmodSupernodalLLt);
  cholmod.analyzePattern(scaled);
  // Near contrast 1e9 round-off can make the last pivots negative. A small shift then gives a
  // preconditioner, and conjugate gradients take the shift out again.
  for (const double shift : {0., 1e-14, 1e-12})
  {
    cholmod.setShift(shift);
    cholmod.factorize(scaled);
    if (cholmod.info() == Eigen::Success)
      return;
  }
  throw meshes::NotConverged(
    what + ": the matrix is not positive definite; expected a connected cell whose parts hang "
           "together by more than single vertices",
    {});
}

CholeskySolver::~CholeskySolver() = default;

CholeskySolver::Solution CholeskySolver::solve(const Eigen::MatrixXd &right_hand_sides) const
{
  // Conjugate gradients for all loads abreast: the factors are read once for all of them. r.z is
  // the square of the distance to the solution in the energy norm, as far as the factors are those
  // of the matrix.
  const auto &cholmod        = factorization->of_cholmod;
  const auto matrix          = scaled.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd b    = scale.asDiagonal() * right_hand_sides;
  const Eigen::Index n_loads = b.cols();
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(b.rows(), n_loads), best = x, direction = x;
  Eigen::MatrixXd residual = b;
  Eigen::ArrayXd energy = Eigen::ArrayXd::Zero(n_loads), product = energy, smallest = energy;
  std::vector<double> history;
  Solution solution;
  constexpr unsigned max_iterations = 100, patience = 2;
  constexpr double enough = 1e-18;
  unsigned since_best     = 0;
  for (unsigned iteration = 0;; ++iteration)
  {
    const Eigen::MatrixXd preconditioned = cholmod.solve(residual);
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
      const Eigen::VectorXd image = matrix * direction.col(load);
      const double curvature      = direction.col(load).dot(image);
      if (curvature > 0.)
        x.col(load) += product(load) / curvature * direction.col(load);
      // The true residual: what a recursion loses to round-off counts here.
      residual.col(load) = b.col(load) - matrix * x.col(load);
    }
  }
  for (Eigen::Index load = 0; load < n_loads; ++load)
    if (energy(load) > 0.)
      solution.excess = std::max(solution.excess, smallest(load) / energy(load));
  if (solution.excess > 1e-3)
    throw meshes::NotConverged(what + ": conjugate gradients do not settle", history);
  solution.values = scale.asDiagonal() * best;
  return solution;
}
} // namespace homespun::homogenization
