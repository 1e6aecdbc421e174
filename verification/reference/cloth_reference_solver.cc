// SPDX-License-Identifier: MIT
#include "verification/reference/cloth_reference_solver.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/refine.h"
#include "verification/newton/halved_parts.h"
#include "verification/record/number_text.h"
#include "verification/reference/cloth_reference_faults.h"
#include "verification/reference/field_integrals.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using namespace dealii;
using homogenization::Node;

namespace
{
constexpr unsigned int most_halvings_of_step = 6; // of a time step

meshes::TriangleMesh checked(const meshes::TriangleMesh &rest,
                             const std::vector<Eigen::Matrix3d> &stiffness,
                             const std::vector<double> &density,
                             const ClothReferenceOptions &options)
{
  const std::vector<std::string> faults = faults_of_cloth(rest, stiffness, density, options);
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return meshes::refined(rest, static_cast<int>(options.refine));
}

/// Integrals of N_i N_j over a triangle of area 1, shapes as deal.II numbers them: vertices, then
/// the midpoints of the edges (0,1), (1,2), (2,0). Lumped: row sums for P1; for P2, whose row sums
/// vanish at the vertices, the diagonal scaled to the whole mass (Hinton, Rock, Zienkiewicz 1976):
/// 1/19 and 16/57.
Eigen::MatrixXd mass_of_unit_triangle(const unsigned int order, const bool consistent)
{
  Eigen::MatrixXd mass;
  if (order == 1)
    mass = (Eigen::Matrix3d::Ones() + Eigen::Matrix3d::Identity()) / 12.;
  else
  {
    mass.resize(6, 6);
    mass << 6., -1., -1., 0., -4., 0., //
      -1., 6., -1., 0., 0., -4.,       //
      -1., -1., 6., -4., 0., 0.,       //
      0., 0., -4., 32., 16., 16.,      //
      -4., 0., 0., 16., 32., 16.,      //
      0., -4., 0., 16., 16., 32.;
    mass /= 180.;
  }
  if (consistent)
    return mass;
  return (mass.diagonal() / mass.trace()).asDiagonal();
}

/// Throws on all ranks where one of them found a fault, so that none waits for another.
void throw_on_all_ranks(const std::string &fault, const MPI_Comm communicator)
{
  if (Utilities::MPI::max(static_cast<int>(!fault.empty()), communicator) == 1)
    throw meshes::BadInput(fault.empty() ? "another rank was given a position that is not finite"
                                         : fault);
}

std::string not_finite(const std::string &what, const Eigen::RowVector2d &point)
{
  return what + " of the rest point (" + std::to_string(point(0)) + ", " +
         std::to_string(point(1)) + ") m is not finite; expected three coordinates [m]";
}
} // namespace

ClothReference::Solver::Solver(const meshes::TriangleMesh &rest,
                               std::vector<Eigen::Matrix3d> stiffness_of_phase,
                               std::vector<double> areal_density_of_phase,
                               const ClothReferenceOptions &options, const MPI_Comm communicator)
    : options(options)
    , stiffness_of_phase(std::move(stiffness_of_phase))
    , areal_density_of_phase(std::move(areal_density_of_phase))
    , n_rest_vertices(rest.n_vertices())
    , discretization(checked(rest, this->stiffness_of_phase, this->areal_density_of_phase, options),
                     options.order, communicator, 3)
    , vertex_dofs(discretization.vertex_dofs())
    , reference_mass(mass_of_unit_triangle(options.order, options.consistent_mass))
    , nodes(discretization.nodes())
    , position(discretization.locally_owned, discretization.communicator)
    , velocity(position)
    , load_origin(position)
{
}

unsigned long ClothReference::Solver::n_dofs() const
{
  return discretization.n_dofs();
}

void ClothReference::Solver::start(const Placement &initial_position, const Held &new_held,
                                   const ClothLoads &new_loads)
{
  if (!new_loads.gravity.allFinite() || !(new_loads.mass_damping >= 0.) ||
      !std::isfinite(new_loads.mass_damping))
    throw meshes::BadInput("gravity or mass damping is not finite, or the damping negative");
  held         = new_held;
  loads        = new_loads;
  present_time = 0.;
  velocity     = 0.;
  std::string fault;
  for (const Node &node : nodes)
    if (discretization.locally_owned.is_element(node.first_dof))
    {
      const Eigen::RowVector3d at = initial_position(node.point);
      if (!at.allFinite())
        fault = not_finite("the initial position", node.point);
      for (unsigned int c = 0; c < 3; ++c)
        position(node.first_dof + c) = at(c);
    }
  position.compress(VectorOperation::insert);
  throw_on_all_ranks(fault, discretization.communicator);
  hold(0.);
  put_held(position);
  positions_at_vertices = at_vertices(position);
}

void ClothReference::Solver::resume(const meshes::SpacePoints &positions,
                                    const meshes::SpacePoints &velocities, const double time)
{
  if (options.order != 1 || options.refine != 0 || positions.rows() != n_rest_vertices ||
      velocities.rows() != n_rest_vertices || !positions.allFinite() || !velocities.allFinite() ||
      !(time >= 0.))
    throw meshes::BadInput("a reference goes on from finite positions and velocities of its " +
                           std::to_string(n_rest_vertices) + " vertices, with P1 alone; found " +
                           std::to_string(positions.rows()) + " and P" +
                           std::to_string(options.order));
  for (int v = 0; v < n_rest_vertices; ++v)
    for (int c = 0; c < 3; ++c)
      if (discretization.locally_owned.is_element(vertex_dofs(v, c)))
      {
        position(vertex_dofs(v, c)) = positions(v, c);
        velocity(vertex_dofs(v, c)) = velocities(v, c);
      }
  position.compress(VectorOperation::insert);
  velocity.compress(VectorOperation::insert);
  present_time = time;
  hold(time);
  put_held(position);
  positions_at_vertices = at_vertices(position);
}

/// Takes up what is held at a time, and the body force; the matrix is laid out anew where that has
/// changed.
void ClothReference::Solver::hold(const double new_time)
{
  const std::size_t n = nodes.size();
  std::string fault;
  held_at.resize(n);
  std::vector<char> now(n);
  for (std::size_t node = 0; node < n; ++node)
  {
    held_at[node] = held(nodes[node].point, new_time);
    now[node]     = held_at[node].has_value();
    if (now[node] && !held_at[node]->allFinite())
      fault = not_finite("the held position", nodes[node].point);
  }
  throw_on_all_ranks(fault, discretization.communicator);
  const bool changed = !solver || now != is_held;
  if (Utilities::MPI::max(static_cast<int>(changed), discretization.communicator) == 1)
  {
    is_held = now;
    lay_out_matrix();
  }
  if (loads.body_force)
    body_load = load_vector(discretization, constraints,
                            [&](const Eigen::RowVector2d &point) -> FieldValue
                            { return loads.body_force(point, new_time).transpose(); });
}

void ClothReference::Solver::put_held(Vector &positions) const
{
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (held_at[node] && discretization.locally_owned.is_element(nodes[node].first_dof))
      for (unsigned int c = 0; c < 3; ++c)
        positions(nodes[node].first_dof + c) = (*held_at[node])(c);
  positions.compress(VectorOperation::insert);
}

void ClothReference::Solver::advance(const double dt, ClothStep &step)
{
  const double new_time = present_time + dt;
  hold(new_time);
  Inertia inertia{1. / (dt * dt) + loads.mass_damping / dt, position};
  inertia.centre.add(1. / (dt * inertia.factor), velocity);
  Vector next = position;
  next.add(dt, velocity);
  put_held(next);
  minimize(next, inertia, 0., step);
  velocity = next;
  velocity.add(-1., position);
  velocity *= 1. / dt;
  position     = next;
  present_time = new_time;
}

ClothStep ClothReference::Solver::step(const double dt)
{
  if (!(dt > 0.) || !std::isfinite(dt))
    throw meshes::BadInput("the time step is " + std::to_string(dt) +
                           " s; expected a positive number");
  Timer timer(discretization.communicator, true);
  ClothStep step;
  const Vector old_position = position, old_velocity = velocity;
  const double old_time = present_time;
  const GoneWay way = go_in_halves(most_halvings_of_step, [&](const double from, const double to)
                                   { advance((to - from) * dt, step); });
  step.n_parts      = way.n_parts;
  step.reached      = way.reached == 1.;
  if (step.reached)
  {
    present_time          = old_time + dt;
    positions_at_vertices = at_vertices(position);
  }
  else
  {
    step.why     = "stopped at " + short_text(present_time) + " s: " + way.failure->what();
    position     = old_position;
    velocity     = old_velocity;
    present_time = old_time;
  }
  timer.stop();
  step.seconds = Utilities::MPI::max(timer.wall_time(), discretization.communicator);
  return step;
}

ClothStep ClothReference::Solver::solve_equilibrium(const double time)
{
  Timer timer(discretization.communicator, true);
  ClothStep step;
  step.n_parts = 1;
  hold(time);
  Vector next = position;
  put_held(next);
  // A tension that lets the sheet sag by a twentieth of its size, and a little where nothing pulls.
  const meshes::Points &rest = discretization.mesh.vertices;
  const double size          = (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).maxCoeff();
  double stiffest            = 0.;
  for (const Eigen::Matrix3d &C : stiffness_of_phase)
    stiffest = std::max(stiffest, C.diagonal().maxCoeff());
  const double heaviest =
    *std::max_element(areal_density_of_phase.begin(), areal_density_of_phase.end());
  const double tension = 2.5 * heaviest * loads.gravity.norm() * size + 1e-4 * stiffest;
  try
  {
    minimize(next, Inertia{0., next}, tension, step);
    position              = next;
    velocity              = 0.;
    present_time          = time;
    positions_at_vertices = at_vertices(position);
    step.reached          = true;
  }
  catch (const meshes::NotConverged &failure)
  {
    step.why = failure.what();
  }
  timer.stop();
  step.seconds = Utilities::MPI::max(timer.wall_time(), discretization.communicator);
  return step;
}

meshes::SpacePoints ClothReference::Solver::at_vertices(const Vector &values) const
{
  meshes::SpacePoints points = meshes::SpacePoints::Zero(n_rest_vertices, 3);
  for (int v = 0; v < n_rest_vertices; ++v) // refinement keeps these in front
    for (int c = 0; c < 3; ++c)
      if (discretization.locally_owned.is_element(vertex_dofs(v, c)))
        points(v, c) = values(vertex_dofs(v, c));
  MPI_Allreduce(MPI_IN_PLACE, points.data(), static_cast<int>(points.size()), MPI_DOUBLE, MPI_SUM,
                discretization.communicator);
  return points;
}

const meshes::SpacePoints &ClothReference::Solver::positions() const
{
  return positions_at_vertices;
}

meshes::SpacePoints ClothReference::Solver::velocities() const
{
  return at_vertices(velocity);
}

double ClothReference::Solver::time() const
{
  return present_time;
}

FieldDistance ClothReference::Solver::distance_from(const KnownField &known) const
{
  return distance(discretization, position, known);
}
} // namespace homespun::verification
