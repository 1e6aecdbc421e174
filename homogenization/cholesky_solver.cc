// SPDX-License-Identifier: MIT
#include "homogenization/cholesky_solver.h"

#include "meshes/errors.h"

#include <Eigen/CholmodSupport>

#include <cmath>
#include <limits>
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

  auto &cholmod = factorization->of_cholmod;
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
  const auto &cholmod = factorization->of_cholmod;
  const auto matrix   = scaled.selfadjointView<Eigen::Lower>();
  Solution solution;
  solution.values.resize(right_hand_sides.rows(), right_hand_sides.cols());
  constexpr unsigned max_iterations = 100;
  for (Eigen::Index load = 0; load < right_hand_sides.cols(); ++load)
  {
    const Eigen::VectorXd b = scale.cwiseProduct(right_hand_sides.col(load));
    Eigen::VectorXd x       = Eigen::VectorXd::Zero(b.size()), best = x;
    Eigen::VectorXd residual = b, direction;
    double energy = 0., product = 0., smallest = std::numeric_limits<double>::infinity();
    std::vector<double> history;
    unsigned since_best = 0;
    for (unsigned iteration = 0; b.squaredNorm() > 0.; ++iteration)
    {
      // r.z is the square of the distance to the solution in the energy norm, as far as the factors are those
      // of the matrix.
      const Eigen::VectorXd preconditioned = cholmod.solve(residual);
      const double old_product             = product;
      product                              = residual.dot(preconditioned);
      energy                               = std::max(energy, product);
      history.push_back(product / energy);
      if (!std::isfinite(product))
        throw meshes::NotConverged(what + ": the solution is not finite", history);
      if (std::abs(product) < smallest)
      {
        smallest   = std::abs(product);
        best       = x;
        since_best = 0;
      }
      else
        ++since_best;
      solution.iterations = std::max(solution.iterations, iteration);
      if (smallest <= 1e-28 * energy || since_best > 3 || iteration == max_iterations)
        break;
      direction =
        iteration == 0 ? preconditioned
                       : Eigen::VectorXd(preconditioned + product / old_product * direction);
      const Eigen::VectorXd image = matrix * direction;
      const double curvature      = direction.dot(image);
      if (!(curvature > 0.))
        break;
      x += product / curvature * direction;
      // The true residual: what the recursion loses to round-off counts here.
      residual = b - matrix * x;
    }
    if (energy > 0.)
      solution.excess = std::max(solution.excess, smallest / energy);
    if (solution.excess > 1e-3)
      throw meshes::NotConverged(what + ": conjugate gradients do not settle", history);
    solution.values.col(load) = scale.cwiseProduct(best);
  }
  return solution;
}
} // namespace homespun::homogenization
