// SPDX-License-Identifier: MIT
#include "shell/solver/conserving_step.h"

#include "meshes/plain/errors.h"

#include <cmath>
#include <limits>

namespace homespun::shell
{
ConservingStep::ConservingStep(const Eigen::VectorXd &masses, const std::vector<bool> &is_held,
                               const SolverOptions &options)
    : masses(masses)
    , is_held(is_held)
    , options(options)
    , matrix(is_held)
{
}

/// The equation of the step at some positions, and its matrix.
ConservingStep::Balance ConservingStep::balance(const std::vector<std::unique_ptr<Term>> &terms,
                                                const Vectors &old, const Vectors &velocities,
                                                const double h, const Vectors &positions)
{
  matrix.clear();
  Balance sum;
  sum.residual     = Vectors::Zero(old.rows(), 3);
  const auto count = [&](const Vectors &own)
  {
    sum.residual += own;
    for (Eigen::Index v = 0; v < own.rows(); ++v)
      if (!is_held[static_cast<std::size_t>(v)])
        sum.size += own.row(v).squaredNorm();
  };
  count(2. / (h * h) * masses.asDiagonal() * (positions - old - h * velocities));
  for (int v = 0; v < static_cast<int>(masses.size()); ++v)
    matrix.add(v, v, 2. * masses(v) / (h * h) * Eigen::Matrix3d::Identity());
  Vectors own(old.rows(), 3);
  for (const auto &term : terms)
  {
    own.setZero();
    term->add_discrete_gradient(old, positions, own, matrix);
    count(own);
  }
  for (Eigen::Index v = 0; v < old.rows(); ++v)
    if (is_held[static_cast<std::size_t>(v)])
      sum.residual.row(v).setZero();
  // The balance changes by this when every position moves by one rounding.
  sum.round_off = 4. * std::numeric_limits<double>::epsilon() * positions.cwiseAbs().maxCoeff() *
                  matrix.traces().norm();
  sum.size = std::sqrt(sum.size);
  sum.norm = sum.residual.norm();
  return sum;
}

void ConservingStep::solve(const std::vector<std::unique_ptr<Term>> &terms, const Vectors &old,
                           const Vectors &velocities, const double h, Vectors &positions,
                           SolveCounts &counts)
{
  Balance now = balance(terms, old, velocities, h, positions);
  std::vector<double> history;
  const auto is_met = [&](const Balance &one)
  { return one.norm <= options.newton_tolerance * one.size + one.round_off; };
  for (int iteration = 0;; ++iteration)
  {
    history.push_back(now.norm);
    const bool is_last = is_met(now);
    if (!std::isfinite(now.norm) || (iteration >= options.max_newton_iterations && !is_last))
      throw meshes::NotConverged("Newton's method of the conserving step", history);
    Vectors step;
    ++counts.newton_iterations;
    if (!matrix.solve(-now.residual, step))
    {
      if (is_last)
        return;
      throw meshes::NotConverged("the matrix of the conserving step is singular", history);
    }
    for (double length = 1.;; length *= 0.5)
    {
      const Vectors trial = positions + length * step;
      Balance next        = balance(terms, old, velocities, h, trial);
      if (next.norm <= (1. - 1e-4 * length) * now.norm)
      {
        positions = trial;
        now       = std::move(next);
        break;
      }
      if (is_last)
        return;
      if (length < 1e-3)
        throw meshes::NotConverged("the line search of the conserving step found no lower residual",
                                   history);
    }
    if (is_last)
      return;
  }
}
} // namespace homespun::shell
