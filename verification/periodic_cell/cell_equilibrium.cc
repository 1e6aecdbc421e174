// SPDX-License-Identifier: MIT
#include "verification/periodic_cell/cell_equilibrium.h"

#include "meshes/plain/errors.h"
#include "verification/newton/newton.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

/// The solution of a matrix, factored; nothing where it is not positive definite.
std::optional<Eigen::MatrixXd> solved(const CellAssembly::Sparse &matrix,
                                      const Eigen::MatrixXd &right)
{
  if (right.rows() == 0)
    return right;
  const Eigen::SimplicialLDLT<CellAssembly::Sparse> factor(matrix);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0.))
    return {};
  return factor.solve(right);
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
  sums.matrix.diagonal() *= 1. + shift;
  const std::optional<Eigen::MatrixXd> answer = solved(sums.matrix, right);
  if (!answer)
    return {};
  NewtonStep step{-answer->col(0), Eigen::VectorXd(G.cols())};
  if (G.cols() == 0)
    return step;
  Eigen::MatrixXd schur = G.transpose() * sums.macro_tangent * G;
  schur.diagonal() *= 1. + shift;
  schur -= right.rightCols(G.cols()).transpose() * answer->rightCols(G.cols());
  const Eigen::LLT<Eigen::MatrixXd> factor(schur);
  if (factor.info() != Eigen::Success)
    return {};
  step.along = factor.solve(loads.stresses - G.transpose() * sums.force +
                            right.rightCols(G.cols()).transpose() * answer->col(0));
  step.unknowns -= answer->rightCols(G.cols()) * step.along;
  return step;
}

/// A cell as Newton's method sees it. What is left of the forces on w and of the stresses along the
/// free directions counts each in parts of its own size.
class CellProblem final : public NewtonProblem
{
public:
  CellProblem(const CellAssembly &assembly, const DeadLoads &loads, CellEquilibrium &kept)
      : assembly(assembly)
      , loads(loads)
      , kept(kept)
      , now(sums_at(kept))
      , trial(kept)
  {
  }

  NewtonState state() override
  {
    return summary(now, work);
  }

  /// The system is factored, exact whatever the reduction. The projected tangent is only
  /// semi-definite: as little of its own diagonal is added as makes it definite.
  double find_step(const Tangent tangent, double) override
  {
    const Sums with_matrix       = assembly.sums(kept.gradient, kept.fluctuation, tangent);
    std::optional<NewtonStep> of = newton_step(with_matrix, loads, 0.);
    if (tangent == Tangent::projected)
      for (double shift = 1e-10; !of && shift <= 1.; shift *= 100.)
        of = newton_step(with_matrix, loads, shift);
    if (!of)
      throw meshes::NotConverged("cell at finite strain: no definite matrix", {});
    step = *of;
    return step.unknowns.dot(now.residual) + step.along.dot(unbalanced(now));
  }

  NewtonState at(const double length) override
  {
    trial = kept;
    trial.gradient += gradient_of(length * (loads.directions * step.along));
    trial.fluctuation += length * assembly.spread(step.unknowns);
    next = sums_at(trial);
    return summary(next, work_at(length));
  }

  void keep(const double length, double) override
  {
    work = work_at(length);
    kept = trial;
    now  = next;
  }

  const Sums &sums() const
  {
    return now;
  }

private:
  Sums sums_at(const CellEquilibrium &at) const
  {
    return assembly.sums(at.gradient, at.fluctuation, Tangent::none);
  }

  double work_at(const double length) const
  {
    return work + length * step.along.dot(loads.stresses);
  }

  Eigen::VectorXd unbalanced(const Sums &sums) const
  {
    return loads.directions.transpose() * sums.force - loads.stresses;
  }

  double stress_scale(const Sums &sums) const
  {
    return std::max(sums.stress_size, loads.stresses.norm());
  }

  bool is_below(const Sums &sums, const double limit, const double round_offs) const
  {
    return sums.residual.norm() < std::max(limit * sums.force_size, round_offs * sums.round_off) &&
           unbalanced(sums).norm() <=
             std::max(limit * stress_scale(sums), round_offs * sums.stress_round_off);
  }

  NewtonState summary(const Sums &sums, const double by_then) const
  {
    constexpr double rounding = 1e-14; // of an energy that is a sum over the triangles
    const double of_forces    = sums.force_size > 0. ? sums.residual.norm() / sums.force_size : 0.;
    const double scale        = stress_scale(sums);
    const double of_stress    = scale > 0. ? unbalanced(sums).norm() / scale : 0.;
    NewtonState state;
    state.energy = sums.energy - by_then;
    // Close to the answer the energy changes by less than its rounding, and the step is Newton's
    // own.
    state.energy_round_off =
      is_below(sums, 1e-7, 10.)
        ? std::numeric_limits<double>::infinity()
        : rounding * (std::abs(sums.energy) + std::abs(by_then)) + sums.energy_round_off;
    state.residual        = std::max(of_forces, of_stress);
    state.least           = 1e-14;
    state.is_at_round_off = is_below(sums, 1e-10, 1.);
    return state;
  }

  const CellAssembly &assembly;
  const DeadLoads &loads;
  double work = 0.; ///< of the dead loads since the start
  CellEquilibrium &kept;
  Sums now;
  CellEquilibrium trial;
  Sums next;
  NewtonStep step;
};
} // namespace

CellEquilibrium at_rest(const CellAssembly &assembly)
{
  return {Eigen::Matrix2d::Identity(), meshes::Points::Zero(assembly.cell.mesh.n_vertices(), 2)};
}

Eigen::Matrix4d macro_tangent(const CellAssembly &assembly, const CellEquilibrium &state)
{
  const Sums sums = assembly.sums(state.gradient, state.fluctuation, Tangent::exact);
  const std::optional<Eigen::MatrixXd> answer = solved(sums.matrix, sums.coupling);
  if (!answer)
    return Eigen::Matrix4d::Constant(std::numeric_limits<double>::quiet_NaN());
  return sums.macro_tangent - sums.coupling.transpose() * *answer;
}

void find_equilibrium(const CellAssembly &assembly, const DeadLoads &loads, CellEquilibrium &state)
{
  CellProblem problem(assembly, loads, state);
  NewtonOptions options;
  options.most_steps      = 40;
  options.shortest_length = 1e-4;
  if (assembly.size() + loads.directions.cols() > 0)
    minimize(problem, options);
  state.energy = problem.sums().energy;
  state.stress = problem.sums().force;
}
} // namespace homespun::verification
