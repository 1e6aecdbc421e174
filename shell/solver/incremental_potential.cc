// SPDX-License-Identifier: MIT
#include "shell/solver/incremental_potential.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::shell
{
IncrementalPotential::IncrementalPotential(const Eigen::VectorXd &masses, std::vector<bool> is_held,
                                           const SolverOptions &options)
    : m(masses)
    , is_held(std::move(is_held))
    , options(options)
{
}

void IncrementalPotential::add(std::unique_ptr<Term> term)
{
  all_terms.push_back(std::move(term));
  matrix.reset();
}

void IncrementalPotential::prepare()
{
  if (matrix)
    return;
  std::vector<std::array<int, 2>> pairs;
  std::vector<bool> no_unknown = is_held; // of vertices, then of the terms' nodes
  for (const auto &term : all_terms)
  {
    const int first = static_cast<int>(no_unknown.size());
    no_unknown.resize(no_unknown.size() + static_cast<std::size_t>(term->take_nodes(first)), false);
    term->couple(pairs);
  }
  matrix = std::make_unique<BlockMatrix>(pairs, no_unknown);
  for (const auto &term : all_terms)
    term->attach(*matrix);
  diagonal.clear();
  for (int i = 0; i < static_cast<int>(m.size()); ++i)
    diagonal.push_back(matrix->slot(i, i));
  cholesky = std::make_unique<BlockCholesky>(*matrix);
}

bool IncrementalPotential::has_energy() const
{
  return std::all_of(all_terms.begin(), all_terms.end(),
                     [](const auto &term) { return term->has_energy(); });
}

double IncrementalPotential::value(const Vectors &positions, const Vectors &inertial,
                                   const double inverse_square) const
{
  double sum = 0.;
  if (inverse_square > 0.)
    sum = 0.5 * inverse_square * m.dot((positions - inertial).rowwise().squaredNorm());
  for (const auto &term : all_terms)
    sum += term->energy(positions);
  return sum;
}

double IncrementalPotential::stored_energy(const Vectors &positions) const
{
  double sum = 0.;
  for (const auto &term : all_terms)
    sum += term->stored_energy(positions);
  return sum;
}

IncrementalPotential::Residual IncrementalPotential::assemble(const Vectors &positions,
                                                              const Vectors &inertial,
                                                              const double inverse_square,
                                                              const Hessian kind)
{
  matrix->clear();
  assembled_gradient.setZero(m.size(), 3);
  Residual residual;
  Vectors own(m.size(), 3);
  const auto collect = [&]()
  {
    for (Eigen::Index i = 0; i < m.size(); ++i)
      if (!is_held[static_cast<std::size_t>(i)])
        residual.size += own.row(i).squaredNorm();
    assembled_gradient += own;
  };
  for (const auto &term : all_terms)
  {
    own.setZero();
    term->add_derivatives(positions, kind, own, *matrix);
    collect();
  }
  if (inverse_square > 0.)
  {
    own = inverse_square * m.asDiagonal() * (positions - inertial);
    collect();
    for (Eigen::Index i = 0; i < m.size(); ++i)
      matrix->add_multiple(diagonal[static_cast<std::size_t>(i)], inverse_square * m(i));
  }
  // Forces change by this when every position moves by one rounding.
  const double rounding = std::numeric_limits<double>::epsilon() * positions.cwiseAbs().maxCoeff();
  double floor          = 0.;
  for (Eigen::Index i = 0; i < m.size(); ++i)
    if (is_held[static_cast<std::size_t>(i)])
      assembled_gradient.row(i).setZero();
    else
      floor += std::pow(rounding * matrix->diagonal(static_cast<int>(i)).trace(), 2);
  residual.size      = std::sqrt(residual.size);
  residual.round_off = 4. * std::sqrt(floor);
  residual.norm      = assembled_gradient.norm();
  return residual;
}

/// A right side with rows of zeros for the terms' nodes.
Vectors IncrementalPotential::with_nodes(const Vectors &right_side) const
{
  Vectors all                    = Vectors::Zero(matrix->n_vertices(), 3);
  all.topRows(right_side.rows()) = right_side;
  return all;
}

bool IncrementalPotential::solve(const Vectors &right_side, Vectors &result, SolveCounts &counts)
{
  ++counts.newton_iterations;
  if (!cholesky->factorize(*matrix))
    return false;
  if (matrix->n_vertices() == m.size())
  {
    cholesky->solve(right_side, result);
    return true;
  }
  Vectors all;
  cholesky->solve(with_nodes(right_side), all);
  result = all.topRows(m.size());
  return true;
}

Vectors IncrementalPotential::linear_step(const Vectors &positions, const Vectors &velocities,
                                          const Vectors &held_displacement, const double h,
                                          SolveCounts &counts)
{
  matrix->clear();
  assembled_gradient.setZero(m.size(), 3);
  for (const auto &term : all_terms)
    term->add_derivatives(positions, Hessian::projected, assembled_gradient, *matrix);
  bool any_held = false;
  for (std::size_t i = 0; i < diagonal.size(); ++i)
  {
    matrix->add_multiple(diagonal[i], m(static_cast<Eigen::Index>(i)) / (h * h));
    any_held = any_held || is_held[i];
  }
  Vectors right_side = (m / h).asDiagonal() * velocities - assembled_gradient;
  if (any_held)
  {
    if (matrix->n_vertices() > m.size())
      right_side = with_nodes(right_side); // a moving handle turns what these stand for
    matrix->subtract_held(held_displacement, right_side);
  }
  Vectors step = h * velocities;
  for (std::size_t i = 0; i < is_held.size(); ++i)
    if (is_held[i])
      step.row(static_cast<Eigen::Index>(i)).setZero();
  if (!solve(right_side, step, counts))
    throw meshes::NotConverged("the step's matrix is not positive definite", {});
  return step;
}

double IncrementalPotential::round_off_of(const double value, const Vectors &positions,
                                          const Residual &residual) const
{
  double sum = std::numeric_limits<double>::epsilon() *
                 std::sqrt(static_cast<double>(positions.rows())) *
                 positions.cwiseAbs().maxCoeff() * residual.size +
               1e-13 * std::abs(value);
  for (const auto &term : all_terms)
    sum += term->round_off(positions);
  return sum;
}

void IncrementalPotential::minimize(const Vectors &inertial, const double h,
                                    const std::function<bool(const Vectors &)> &is_enough,
                                    Vectors &positions, SolveCounts &counts)
{
  const double inverse_square = 1. / (h * h);
  const bool descends         = has_energy();
  double potential            = value(positions, inertial, inverse_square);
  bool try_exact              = true;
  Vectors step, trial;
  std::vector<double> history;
  const auto give_up = [&](const char *what)
  {
    if (!is_enough(positions))
      throw meshes::NotConverged(what, history);
    ++counts.unconverged;
  };
  for (int iteration = 0;; ++iteration)
  {
    const Residual residual = assemble(positions, inertial, inverse_square,
                                       try_exact ? Hessian::exact : Hessian::projected);
    history.push_back(residual.norm);
    if (!std::isfinite(residual.norm))
      throw meshes::NotConverged("a force is not finite", history);
    if (residual.is_below(options.newton_tolerance))
      return;
    if (iteration >= options.max_newton_iterations)
      return give_up("Newton's method of the step");
    const Vectors forces = -assembled_gradient;
    step.setZero(m.size(), 3);
    bool solved = solve(forces, step, counts);
    if (!solved && try_exact)
    {
      try_exact = false;
      assemble(positions, inertial, inverse_square, Hessian::projected);
      solved = solve(forces, step, counts);
    }
    if (!solved)
      throw meshes::NotConverged("the step's matrix is not positive definite", history);
    const double slope = -forces.cwiseProduct(step).sum();
    const double slack = round_off_of(potential, positions, residual);
    for (double length = 1.;; length *= 0.5)
    {
      if (length < 1e-6)
        return give_up("the line search of the step found no lower potential");
      trial             = positions + length * step;
      const double next = value(trial, inertial, inverse_square);
      if (descends && !(next <= potential + 1e-4 * length * slope + slack))
        continue;
      potential = next;
      positions = trial;
      if (length == 1.)
        try_exact = true;
      break;
    }
  }
}

double IncrementalPotential::stiffness_at(const int vertex) const
{
  return matrix->is_free(vertex) ? matrix->diagonal(vertex).trace() : 0.;
}

std::size_t IncrementalPotential::bytes() const
{
  std::size_t sum = static_cast<std::size_t>(assembled_gradient.size()) * sizeof(double);
  for (const auto &term : all_terms)
    sum += term->bytes();
  if (matrix)
    sum += matrix->bytes() + diagonal.size() * sizeof(BlockMatrix::Slot) + cholesky->bytes();
  return sum;
}
} // namespace homespun::shell
