// SPDX-License-Identifier: MIT
#include "verification/reference/fine_reference_solver.h"

#include "homogenization/fem/periodic_constraints.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/refine.h"
#include "verification/newton/halved_parts.h"
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

namespace
{
constexpr unsigned int most_halvings_of_level = 3; // of the way from one level to the next
/// Steps after which a part of that way is given up that can be halved. Sheets of 20 x 20 cells
/// that are found in one part take one to five; layered at 20 % shear, which stalls, is halved.
constexpr unsigned int most_steps_of_long_parts = 12;
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
  return discretization.n_dofs();
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
  constraints.reinit(discretization.locally_active);
  for (const homogenization::Node &node : boundary)
    if (const Eigen::RowVector2d f = sheet.fraction(node.point);
        load.holds(f) && discretization.locally_active.is_element(node.first_dof))
    {
      constraints.add_line(node.first_dof);
      constraints.add_line(node.second_dof);
      clamp_of_node[node.first_dof] = f(load.axis()) < 0.5 ? 0 : 1;
    }
  constraints.close();
}

void FineReference::Solver::start(const Load &new_load, const Law new_law, BodyForce new_body_force)
{
  if (!load || load->name != new_load.name)
  {
    cells.reset(); // before its matrix, and that before its constraints change
    solver.reset();
    linear_rate.reset();
    seconds_of_linear_solve = 0.;
    load                    = std::make_unique<Load>(new_load);
    constrain(*load);
    solver = std::make_unique<homogenization::ElasticSolver>(discretization, constraints);
    cells  = std::make_unique<homogenization::CellEntries>(discretization, constraints, *solver);
  }
  law        = new_law;
  body_force = std::move(new_body_force);
  phases.clear();
  for (const Eigen::Matrix3d &C : stiffness_of_phase)
    phases.emplace_back(law, C);
  if (body_force)
    linear_rate.reset();
  body_load.clear();
  levels.clear();
  free_strains.setZero();
  side_slope.setZero();
}

/// The affine displacement that agrees with the prescribed one; of periodic loads no fluctuation.
FineReference::Solver::Vector FineReference::Solver::affine(const double strain) const
{
  Vector displacement = solver->owned_vector();
  if (load->is_periodic())
    return displacement;
  for (const homogenization::Node &node : discretization.nodes())
  {
    if (!discretization.locally_owned.is_element(node.first_dof))
      continue;
    const Eigen::RowVector2d moved =
      load->displacement(sheet.fraction(node.point), sheet.sides(), strain);
    displacement(node.first_dof)  = moved(0);
    displacement(node.second_dof) = moved(1);
  }
  displacement.compress(VectorOperation::insert);
  return displacement;
}

/// All loads are proportional to strain, u = s v(s), and v(0) is that of linear theory: v is the
/// polynomial through some levels.
FineReference::Solver::SolvedLevel
FineReference::Solver::extrapolated(const std::vector<const SolvedLevel *> &from,
                                    const double strain) const
{
  SolvedLevel result{strain, solver->owned_vector(), Eigen::Vector2d::Zero()};
  for (const SolvedLevel *const level : from)
  {
    double weight = strain * level->rate;
    for (const SolvedLevel *const other : from)
      if (other != level)
        weight *= (strain - other->strain) / (level->strain - other->strain);
    result.displacement.add(weight, level->displacement);
    result.free_strains += weight * level->free_strains;
  }
  return result;
}

/// Where Newton's method begins: of the polynomials through fewer and fewer levels the one whose
/// residual is smallest. Far from linear theory the long ones overshoot.
FineReference::Solver::SolvedLevel FineReference::Solver::guess(const double strain)
{
  std::vector<const SolvedLevel *> from;
  if (linear_rate && law != Law::linear)
    from.push_back(&*linear_rate);
  for (const SolvedLevel &level : levels)
    from.push_back(&level);
  if (from.empty())
    return {strain, affine(strain), Eigen::Vector2d::Zero()};
  if (law == Law::linear)
    return extrapolated({from.back()}, strain);
  std::optional<SolvedLevel> best;
  double least    = 0.;
  Vector residual = solver->owned_vector();
  for (; !from.empty(); from.erase(from.begin()))
  {
    const SolvedLevel next = extrapolated(from, strain);
    free_strains           = next.free_strains;
    const Evaluation state =
      evaluate(next.displacement, mean_gradient_at(strain), residual, Tangent::none);
    const double left =
      std::isfinite(state.energy) ? state.residual : std::numeric_limits<double>::infinity();
    if (best && !(left < least))
      break;
    best  = next;
    least = left;
  }
  return *best;
}

/// Solves at a strain, which becomes the last level.
/// @throws NotConverged
void FineReference::Solver::go_to(const double strain, ReferenceStep &step)
{
  take_body_force(strain);
  SolvedLevel next = guess(strain);
  if (levels.empty())
    side_slope.setZero(); // what a first step that failed has left of it is no start
  free_strains = next.free_strains;
  solve_with_sides(next.displacement, strain, options.tolerance, step);
  next.free_strains = free_strains;
  next.rate         = 1. / strain;
  if (levels.size() == 3)
    levels.erase(levels.begin());
  levels.push_back(next);
  if (law == Law::linear && !body_force)
    linear_rate = SolvedLevel{0., next.displacement, next.free_strains, next.rate};
}

ReferenceStep FineReference::Solver::advance(const double strain)
{
  Timer timer(discretization.communicator, true);
  ReferenceStep step;
  step.strain = strain;

  const double before = levels.empty() ? 0. : levels.back().strain;
  const GoneWay way =
    go_in_halves(law == Law::linear ? 0 : most_halvings_of_level,
                 [&](const double from, const double part)
                 {
                   const bool can_be_halved =
                     law != Law::linear && std::ldexp(part - from, most_halvings_of_level) > 1.;
                   most_newton_steps =
                     can_be_halved ? most_steps_of_long_parts : NewtonOptions().most_steps;
                   go_to(part == 1. ? strain : before + part * (strain - before), step);
                 });
  most_newton_steps    = NewtonOptions().most_steps;
  const double reached = levels.empty() ? 0. : levels.back().strain;
  step.reached         = way.reached == 1.;
  if (step.reached)
    step.positions = positions_of(levels.back().displacement, strain);
  else
  {
    step.why        = "stopped at strain " + short_text(reached) + ": " + way.failure->what();
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
