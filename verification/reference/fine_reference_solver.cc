// SPDX-License-Identifier: MIT
#include "verification/reference/fine_reference_solver.h"

#include "homogenization/fem/periodic_constraints.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/refine.h"
#include "verification/record/number_text.h"
#include "verification/reference/field_integrals.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
using namespace dealii;
using homogenization::AffineTriangle;
using homogenization::Discretization;
using homogenization::ReferenceElement;

namespace
{
/// Sheets of weaves, a thousand times as stiff along the yarns as in shear, take some hundreds.
constexpr unsigned int most_linear_iterations = 3000;
} // namespace

FineReference::Solver::Solver(const meshes::Sheet &sheet,
                              std::vector<Eigen::Matrix3d> stiffness_of_phase,
                              const ReferenceOptions &options, const MPI_Comm communicator)
    : sheet(sheet)
    , stiffness_of_phase(std::move(stiffness_of_phase))
    , options(options)
    , discretization(meshes::refined(sheet.mesh, static_cast<int>(options.refine)), options.order,
                     communicator)
    , vertex_dofs(discretization.vertex_dofs())
    , boundary(discretization.boundary_nodes())
{
}

unsigned long FineReference::Solver::n_dofs() const
{
  return discretization.dof_handler.n_dofs();
}

void FineReference::Solver::constrain(const Load &load)
{
  clamp_of_node.clear();
  if (load.is_periodic())
  {
    const meshes::Lattice period = {sheet.sides()}; // of all cells of the sheet
    homogenization::make_periodic_constraints(discretization, period, sheet.origin, boundary,
                                              constraints);
    homogenization::audit_periodic_constraints(discretization, period, sheet.origin, boundary,
                                               constraints);
    return;
  }
  constraints.clear();
  constraints.reinit(discretization.locally_relevant);
  for (const homogenization::Node &node : boundary)
    if (const Eigen::RowVector2d f = sheet.fraction(node.point);
        load.holds(f) && discretization.locally_relevant.is_element(node.first_dof))
    {
      constraints.add_line(node.first_dof);
      constraints.add_line(node.second_dof);
      clamp_of_node[node.first_dof] = f(load.clamped_axis()) < 0.5 ? 0 : 1;
    }
  constraints.close();
}

void FineReference::Solver::start(const Load &new_load, const Law new_law, BodyForce new_body_force)
{
  if (!load || load->name != new_load.name)
  {
    solver.reset(); // before its constraints change
    load = std::make_unique<Load>(new_load);
    constrain(*load);
    solver = std::make_unique<homogenization::ElasticSolver>(discretization, constraints);
  }
  law        = new_law;
  body_force = std::move(new_body_force);
  body_load.clear();
  levels.clear();
  free_strains.setZero();
  side_slope.setZero();
  seconds_of_linear_solve = 0.;
}

/// The affine displacement that agrees with the prescribed one; of periodic loads no fluctuation.
FineReference::Solver::Vector FineReference::Solver::affine(const double strain) const
{
  Vector displacement = solver->owned_vector();
  if (load->is_periodic())
    return displacement;
  for (const homogenization::Node &node : discretization.owned_nodes())
  {
    const Eigen::RowVector2d moved =
      load->displacement(sheet.fraction(node.point), sheet.sides(), strain);
    displacement(node.first_dof)  = moved(0);
    displacement(node.second_dof) = moved(1);
  }
  displacement.compress(VectorOperation::insert);
  return displacement;
}

/// All loads are proportional to strain, u = s v(s): v is extrapolated from the last two levels.
FineReference::Solver::Vector FineReference::Solver::guess(const double strain) const
{
  if (levels.empty())
    return affine(strain);
  Vector displacement = levels.back().displacement;
  if (levels.size() == 1 || law == Law::linear)
    displacement *= strain / levels.back().strain;
  else
  {
    const double s0 = levels[0].strain, s1 = levels[1].strain;
    displacement *= strain / s1 * (strain - s0) / (s1 - s0);
    displacement.add(strain / s0 * (s1 - strain) / (s1 - s0), levels[0].displacement);
  }
  return displacement;
}

/// Conjugate gradients with the multigrid hierarchy of an earlier matrix, as long as that serves.
unsigned int FineReference::Solver::solve_linearized(Vector &increment, const Vector &forces,
                                                     const double target)
{
  const bool is_new = !solver->has_preconditioner() || preconditioner_is_old;
  if (is_new)
    solver->build_preconditioner();
  // Should this solve fail, the next one has a hierarchy of its own.
  preconditioner_is_old   = true;
  increment               = 0.;
  const unsigned int used = solver->solve(increment, forces, target, most_linear_iterations);
  // A hierarchy serves until it costs half as much again, per digit gained.
  const double digits    = std::log10(std::max(10., forces.l2_norm() / target));
  const double per_digit = (used + 1) / digits;
  if (is_new)
    iterations_per_digit_when_new = per_digit;
  preconditioner_is_old = per_digit > 1.5 * iterations_per_digit_when_new;
  return used;
}

/// Newton's method from `displacement`, which carries the prescribed values of this strain.
/// @throws NotConverged
void FineReference::Solver::solve(Vector &displacement, const double strain, const double tolerance,
                                  ReferenceStep &step)
{
  const Eigen::Matrix2d mean_gradient = mean_gradient_at(strain);
  if (body_force)
    body_load = load_vector(discretization, constraints,
                            [&](const Eigen::RowVector2d &point)
                            {
                              const Eigen::RowVector2d force = body_force(point, strain);
                              return FieldValue(force(0), force(1), 0.);
                            });
  Vector residual = solver->owned_vector(), increment = solver->owned_vector();
  Vector trial     = solver->owned_vector();
  Evaluation state = evaluate(displacement, mean_gradient, residual, Tangent::none);
  std::vector<double> history;
  constexpr unsigned int most_steps = 30;
  for (unsigned int newton = 0; newton <= most_steps; ++newton)
  {
    history.push_back(state.residual / state.force_size);
    step.relative_residual = history.back();
    step.energy            = state.energy;
    step.forces            = state.forces;
    if (!std::isfinite(state.residual) || !std::isfinite(state.energy))
      throw meshes::NotConverged("the sheet collapsed under the load step", history);
    // A sheet without load has no forces at all.
    if (state.residual <= state.least_residual(tolerance))
    {
      step.n_inverted      = law == Law::linear ? 0 : state.n_inverted;
      step.is_at_round_off = state.residual > tolerance * state.force_size;
      return;
    }
    if (newton == most_steps || (newton >= 15 && history[newton] > 0.5 * history[newton - 10]))
      break;

    // As exact as the next step of Newton's method can use; a linear law needs one step.
    const double needed = 0.1 * state.least_residual(tolerance);
    const double target = law == Law::linear ? needed : std::max(needed, 1e-3 * state.residual);
    residual *= -1.;
    const Vector forces = residual;
    // The exact tangent first, which ends quadratically; where it is indefinite, the projected one.
    for (const Tangent tangent : {Tangent::exact, Tangent::projected})
      try
      {
        const Evaluation assembled = evaluate(displacement, mean_gradient, trial, tangent);
        if (tangent == Tangent::exact)
          step.n_indefinite = assembled.n_indefinite;
        step.n_linear += solve_linearized(increment, forces, target);
        break;
      }
      catch (const meshes::NotConverged &)
      {
        if (tangent == Tangent::projected || law == Law::linear)
          throw;
      }
    constraints.distribute(increment);
    ++step.n_newton;

    const double slope = -(forces * increment);
    double length      = 1.;
    Evaluation next;
    while (true)
    {
      trial = displacement;
      trial.add(length, increment);
      next                 = evaluate(trial, mean_gradient, residual, Tangent::none);
      const double allowed = state.energy + 1e-4 * length * slope + 1e-13 * std::abs(state.energy) +
                             state.energy_round_off;
      if (next.energy <= allowed || (law == Law::linear && std::isfinite(next.energy)))
        break;
      length *= 0.5;
      if (length < 1e-3)
        throw meshes::NotConverged("the line search found no lower energy", history);
    }
    displacement = trial;
    state        = next;
  }
  throw meshes::NotConverged("Newton's method stalls", history);
}

ReferenceStep FineReference::Solver::advance(const double strain)
{
  Timer timer(discretization.communicator, true);
  ReferenceStep step;
  step.strain = strain;

  double reached   = levels.empty() ? 0. : levels.back().strain;
  double next      = strain;
  unsigned int cut = 0;
  while (!step.reached && cut <= (law == Law::linear ? 0u : 3u))
  {
    Vector displacement = guess(next);
    if (levels.empty())
    { // what a first step that failed has left of them is no start
      free_strains.setZero();
      side_slope.setZero();
    }
    else
      free_strains = next / levels.back().strain * levels.back().free_strains;
    try
    {
      solve_with_sides(displacement, next, options.tolerance, step);
      if (levels.size() == 2)
        levels.erase(levels.begin());
      levels.push_back({next, displacement, free_strains});
      reached      = next;
      step.reached = next == strain;
      next         = strain;
    }
    catch (const meshes::NotConverged &failure)
    {
      step.why = failure.what();
      next     = 0.5 * (reached + next);
      ++cut;
    }
  }
  if (step.reached)
  {
    step.why.clear();
    step.positions = positions_of(levels.back().displacement, strain);
  }
  else
  {
    step.why        = "stopped at strain " + short_text(reached) + ": " + step.why;
    step.stopped_at = reached;
    if (!levels.empty())
    {
      free_strains   = levels.back().free_strains;
      step.positions = positions_of(levels.back().displacement, reached);
    }
  }
  timer.stop();
  step.seconds = Utilities::MPI::max(timer.wall_time(), discretization.communicator);
  // Later levels of a linear law are multiples of the first; what a solve costs is the first.
  if (law == Law::linear && step.reached)
  {
    if (step.n_linear > 0)
      seconds_of_linear_solve = step.seconds;
    step.seconds = std::max(step.seconds, seconds_of_linear_solve);
  }
  return step;
}

FieldDistance FineReference::Solver::distance_from(const KnownField &known) const
{
  AssertThrow(!levels.empty(), ExcMessage("no level has been solved"));
  return distance(discretization, levels.back().displacement, known, load->is_periodic());
}

ReferenceStep FineReference::Solver::tighten(const double tolerance)
{
  Timer timer(discretization.communicator, true);
  ReferenceStep step;
  step.strain = levels.back().strain;
  try
  {
    Vector displacement = levels.back().displacement;
    solve_with_sides(displacement, step.strain, tolerance, step);
    levels.back().displacement = displacement;
    levels.back().free_strains = free_strains;
    step.reached               = true;
    step.positions             = positions_of(displacement, step.strain);
  }
  catch (const meshes::NotConverged &failure)
  {
    step.why = failure.what();
  }
  timer.stop();
  step.seconds = Utilities::MPI::max(timer.wall_time(), discretization.communicator);
  return step;
}

Eigen::Matrix2d FineReference::Solver::mean_gradient_at(const double strain) const
{
  if (load->has_free_sides())
    return load->gradient(strain, free_strains);
  return load->is_periodic() ? load->gradient(strain) : Eigen::Matrix2d::Identity();
}

meshes::Points FineReference::Solver::positions_of(const Vector &displacement,
                                                   const double strain) const
{
  const int n              = sheet.mesh.n_vertices(); // refinement keeps these in front
  meshes::Points positions = meshes::Points::Zero(n, 2);
  for (int v = 0; v < n; ++v)
    for (int c = 0; c < 2; ++c)
      if (discretization.locally_owned.is_element(vertex_dofs(v, c)))
        positions(v, c) = displacement(vertex_dofs(v, c));
  MPI_Allreduce(MPI_IN_PLACE, positions.data(), static_cast<int>(positions.size()), MPI_DOUBLE,
                MPI_SUM, discretization.communicator);
  const Eigen::Matrix2d mean_gradient = mean_gradient_at(strain);
  for (int v = 0; v < n; ++v)
  {
    const Eigen::RowVector2d arm = sheet.mesh.vertices.row(v) - sheet.origin;
    positions.row(v) += sheet.origin + arm * mean_gradient.transpose();
  }
  return positions;
}
} // namespace homespun::verification
