// SPDX-License-Identifier: MIT
#include "verification/periodic_cell/cell_equilibrium.h"

#include "meshes/plain/errors.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace homespun::verification
{
namespace
{
using Sums = CellAssembly::Sums;

Eigen::Matrix2d gradient_of(const Eigen::Vector4d &entries)
{
  Eigen::Matrix2d F;
  F << entries(0), entries(1), entries(2), entries(3);
  return F;
}

struct NewtonStep
{
  Eigen::VectorXd unknowns; ///< of w
  Eigen::VectorXd along;    ///< the free directions of F
};

/// The block system of w and q, q by its Schur complement; nothing where it is not positive
/// definite.
/// @param shift what is added to the diagonal, relative to it
std::optional<NewtonStep> newton_step(Sums sums, const DeadLoads &loads, const double shift)
{
  const auto &G = loads.directions;
  Eigen::MatrixXd right(sums.residual.size(), 1 + G.cols());
  right << sums.residual, sums.coupling * G;
  Eigen::MatrixXd answer = right;
  if (right.rows() > 0)
  {
    sums.matrix.diagonal() *= 1. + shift;
    const Eigen::SimplicialLDLT<CellAssembly::Sparse> factor(sums.matrix);
    if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.))
      return {};
    answer = factor.solve(right);
  }
  NewtonStep step{-answer.col(0), Eigen::VectorXd(G.cols())};
  if (G.cols() == 0)
    return step;
  Eigen::MatrixXd schur = G.transpose() * sums.macro_tangent * G;
  schur.diagonal() *= 1. + shift;
  schur -= right.rightCols(G.cols()).transpose() * answer.rightCols(G.cols());
  const Eigen::LLT<Eigen::MatrixXd> factor(schur);
  if (factor.info() != Eigen::Success)
    return {};
  step.along = factor.solve(loads.stresses - G.transpose() * sums.force +
                            right.rightCols(G.cols()).transpose() * answer.col(0));
  step.unknowns -= answer.rightCols(G.cols()) * step.along;
  return step;
}

/// Newton's own step where the second derivative is positive definite; else that of the projected
/// one, which is only semi-definite, with as little of its own diagonal as makes it definite.
NewtonStep definite_step(const CellAssembly &assembly, const DeadLoads &loads,
                         const CellEquilibrium &state, const std::vector<double> &history)
{
  const auto sums = [&](const Tangent tangent)
  { return assembly.sums(state.gradient, state.fluctuation, tangent); };
  if (const auto step = newton_step(sums(Tangent::exact), loads, 0.))
    return *step;
  for (double shift = 1e-10; shift <= 1.; shift *= 100.)
    if (const auto step = newton_step(sums(Tangent::projected), loads, shift))
      return *step;
  throw meshes::NotConverged("cell at finite strain: no definite matrix", history);
}
} // namespace

Eigen::Matrix4d macro_tangent(const CellAssembly &assembly, const CellEquilibrium &state)
{
  const Sums sums = assembly.sums(state.gradient, state.fluctuation, Tangent::exact);
  if (assembly.size() == 0)
    return sums.macro_tangent;
  const Eigen::SimplicialLDLT<CellAssembly::Sparse> factor(sums.matrix);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.))
    return Eigen::Matrix4d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::MatrixXd answer = factor.solve(Eigen::MatrixXd(sums.coupling));
  return sums.macro_tangent - sums.coupling.transpose() * answer;
}

void find_equilibrium(const CellAssembly &assembly, const DeadLoads &loads, CellEquilibrium &state)
{
  constexpr double rounding = 1e-14; // of an energy that is a sum over the triangles
  const auto &G             = loads.directions;
  const auto sums_at        = [&](const CellEquilibrium &at)
  { return assembly.sums(at.gradient, at.fluctuation, Tangent::none); };
  // What is left of the forces on w and of the stresses along G, each in parts of its own size.
  const auto unbalanced = [&](const Sums &sums)
  { return (G.transpose() * sums.force - loads.stresses).norm(); };
  const double prescribed = loads.stresses.norm();
  const auto is_below     = [&](const Sums &sums, const double limit, const double round_offs)
  {
    return sums.residual.norm() < std::max(limit * sums.force_size, round_offs * sums.round_off) &&
           unbalanced(sums) <= std::max(limit * std::max(sums.stress_size, prescribed),
                                        round_offs * sums.stress_round_off);
  };
  std::vector<double> history;
  Sums now = sums_at(state);
  for (int newton = 0;; ++newton)
  {
    const double of_forces = now.force_size > 0. ? now.residual.norm() / now.force_size : 0.;
    const double scale     = std::max(now.stress_size, prescribed);
    const double of_stress = scale > 0. ? unbalanced(now) / scale : 0.;
    history.push_back(std::max(of_forces, of_stress));
    const bool is_stuck =
      newton > 2 && is_below(now, 1e-10, 1.) && history.back() > 0.5 * history[history.size() - 2];
    if (history.back() <= 1e-14 || is_stuck || assembly.size() + G.cols() == 0)
      break;
    if (newton == 40 || !std::isfinite(now.energy))
      throw meshes::NotConverged("cell at finite strain: Newton's method stalls", history);
    const NewtonStep step = definite_step(assembly, loads, state, history);
    const double slope =
      step.unknowns.dot(now.residual) + step.along.dot(G.transpose() * now.force - loads.stresses);
    // Close to the answer the energy changes by less than its rounding, and the step is Newton's
    // own.
    const bool is_close = is_below(now, 1e-7, 10.);
    for (double length = 1.;; length *= 0.5)
    {
      CellEquilibrium trial = state;
      trial.gradient += gradient_of(length * (G * step.along));
      trial.fluctuation += length * assembly.spread(step.unknowns);
      const Sums next   = sums_at(trial);
      const double work = length * step.along.dot(loads.stresses);
      if (is_close || next.energy - work <= now.energy + 1e-4 * length * slope +
                                              rounding * (std::abs(now.energy) + std::abs(work)) +
                                              now.energy_round_off)
      {
        state = trial;
        now   = next;
        break;
      }
      if (length < 1e-4)
        throw meshes::NotConverged("cell at finite strain: the line search found no lower energy",
                                   history);
    }
  }
  state.energy = now.energy;
  state.stress = now.force;
}
} // namespace homespun::verification
