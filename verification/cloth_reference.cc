// SPDX-License-Identifier: MIT
#include "verification/cloth_reference.h"

#include "meshes/errors.h"
#include "meshes/refine.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <Eigen/Eigenvalues>
#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace homespun::verification
{
using namespace dealii;
using homogenization::AffineTriangle;
using homogenization::ElasticSolver;
using homogenization::ReferenceElement;

namespace
{
constexpr double machine_epsilon              = std::numeric_limits<double>::epsilon();
constexpr unsigned int most_linear_iterations = 300;

std::vector<std::string> faults_of(const meshes::TriangleMesh &rest,
                                   const std::vector<Eigen::Matrix3d> &stiffness,
                                   const std::vector<double> &density,
                                   const ClothReferenceOptions &options)
{
  std::vector<std::string> faults = meshes::faults_of(rest, "the rest mesh");
  if (options.law == Law::linear)
    faults.push_back("the law is linear, which no rotation leaves alone; expected biot or green");
  if (options.order != 1 && options.order != 2)
    faults.push_back("the order is " + std::to_string(options.order) + "; expected 1 or 2");
  if (!(options.tolerance > 0.))
    faults.push_back("the tolerance is " + std::to_string(options.tolerance) +
                     "; expected a positive number");
  if (stiffness.size() != density.size())
    faults.push_back("there are " + std::to_string(stiffness.size()) + " stiffnesses but " +
                     std::to_string(density.size()) + " densities; expected one of each per phase");
  for (std::size_t p = 0; p < stiffness.size(); ++p)
  {
    const Eigen::Matrix3d &C = stiffness[p];
    if (!C.allFinite() || (C - C.transpose()).norm() > 1e-12 * C.norm() ||
        !(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C).eigenvalues()(0) > 0.))
      faults.push_back("the stiffness of phase " + std::to_string(p) +
                       " is not symmetric and positive definite");
  }
  for (std::size_t p = 0; p < density.size(); ++p)
    if (!(density[p] > 0.) || !std::isfinite(density[p]))
      faults.push_back("the density of phase " + std::to_string(p) + " is " +
                       std::to_string(density[p]) + "; expected a positive number [kg/m^2]");
  const int n_phases = static_cast<int>(stiffness.size());
  if (rest.material.size() != rest.n_triangles())
    faults.push_back("the rest mesh has " + std::to_string(rest.n_triangles()) +
                     " triangles but a phase for " + std::to_string(rest.material.size()));
  else
    for (int t = 0; t < rest.n_triangles(); ++t)
      if (rest.material(t) < 0 || rest.material(t) >= n_phases)
      {
        faults.push_back("triangle " + std::to_string(t) + " has phase " +
                         std::to_string(rest.material(t)) + "; expected 0 to " +
                         std::to_string(n_phases - 1));
        break;
      }
  return faults;
}

meshes::TriangleMesh checked(const meshes::TriangleMesh &rest,
                             const std::vector<Eigen::Matrix3d> &stiffness,
                             const std::vector<double> &density,
                             const ClothReferenceOptions &options)
{
  const std::vector<std::string> faults = faults_of(rest, stiffness, density, options);
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return meshes::refined(rest, static_cast<int>(options.refine));
}

/// Integrals of N_i N_j over a triangle of area 1, shapes as deal.II numbers them: vertices, then the
/// midpoints of the edges (0,1), (1,2), (2,0). Lumped: row sums for P1; for P2, whose row sums vanish at
/// the vertices, the diagonal scaled to the whole mass (Hinton, Rock, Zienkiewicz 1976): 1/19 and 16/57.
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

bool ClothReference::State::is_converged(const double tolerance) const
{
  // A cloth without loads has forces from rounding only.
  return residual <= std::max(tolerance * force_size, round_off);
}

ClothReference::ClothReference(const meshes::TriangleMesh &rest,
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
{
  lay_out();
}

/// Elements and nodes. A rank computes all triangles that touch one of its nodes, its neighbours' too:
/// each row of the matrix is then complete without sending any.
void ClothReference::lay_out()
{
  const IndexSet &relevant = discretization.locally_relevant;
  const IndexSet &owned    = discretization.locally_owned;
  const std::size_t n      = relevant.n_elements() / 3;
  node_points.resize(n);
  node_dofs.resize(n);
  owned_row.assign(n, -1);
  std::vector<types::global_dof_index> dofs(discretization.element.n_dofs_per_cell());
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
  {
    if (cell->is_artificial())
      continue;
    cell->get_dof_indices(dofs);
    const unsigned int t = homogenization::Discretization::triangle_of(cell);
    const AffineTriangle triangle(discretization.mesh, t);
    Element element;
    // An owned triangle counts in the energy even where neighbours own all of its nodes.
    bool is_needed = cell->is_locally_owned();
    for (unsigned int shape = 0; shape < dofs.size() / 3; ++shape)
    {
      const types::global_dof_index dof = dofs[3 * shape];
      const std::size_t node            = relevant.index_within_set(dof) / 3;
      element.nodes.push_back(static_cast<int>(node));
      node_points[node] = discretization.point_of(cell, shape);
      node_dofs[node]   = dof;
      if (owned.is_element(dof))
      {
        owned_row[node] = static_cast<int>(owned.index_within_set(dof));
        is_needed       = true;
      }
    }
    element.inverse_transpose = triangle.inverse_transpose;
    element.determinant       = triangle.determinant;
    element.phase             = discretization.mesh.material(t);
    element.is_owned          = cell->is_locally_owned();
    if (is_needed)
      elements.push_back(element);
  }
  position.reinit(owned, discretization.communicator);
  velocity    = position;
  load_origin = position;
}

unsigned long ClothReference::n_dofs() const
{
  return discretization.dof_handler.n_dofs();
}

void ClothReference::start(const Placement &initial_position, const Held &new_held,
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
  for (std::size_t node = 0; node < node_points.size(); ++node)
    if (owned_row[node] >= 0)
    {
      const Eigen::RowVector3d at = initial_position(node_points[node]);
      if (!at.allFinite())
        fault = not_finite("the initial position", node_points[node]);
      for (int c = 0; c < 3; ++c)
        position.begin()[owned_row[node] + c] = at(c);
    }
  throw_on_all_ranks(fault, discretization.communicator);
  hold(0.);
  put_held(position);
  positions_at_vertices = at_vertices(position);
}

void ClothReference::resume(const meshes::SpacePoints &positions,
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

/// Takes up what is held at a time, and the body force; the matrix is laid out anew where that has changed.
void ClothReference::hold(const double new_time)
{
  const std::size_t n = node_points.size();
  std::string fault;
  held_at.resize(n);
  std::vector<char> now(n);
  for (std::size_t node = 0; node < n; ++node)
  {
    held_at[node] = held(node_points[node], new_time);
    now[node]     = held_at[node].has_value();
    if (now[node] && !held_at[node]->allFinite())
      fault = not_finite("the held position", node_points[node]);
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

void ClothReference::put_held(Vector &positions) const
{
  for (std::size_t node = 0; node < node_points.size(); ++node)
    if (owned_row[node] >= 0 && held_at[node])
      for (int c = 0; c < 3; ++c)
        positions.begin()[owned_row[node] + c] = (*held_at[node])(c);
}

/// The matrix, and where each 3x3 block of each element goes in the rows of this rank, so that an
/// assembly need not search for it.
void ClothReference::lay_out_matrix()
{
  solver.reset(); // before its constraints change
  constraints.clear();
  constraints.reinit(discretization.locally_relevant);
  for (std::size_t node = 0; node < node_points.size(); ++node)
    if (is_held[node])
      for (unsigned int c = 0; c < 3; ++c)
        constraints.add_line(node_dofs[node] + c);
  constraints.close();
  solver                = std::make_unique<ElasticSolver>(discretization, constraints);
  preconditioner_is_old = true;

  const Epetra_CrsMatrix &matrix = solver->matrix.trilinos_matrix();
  row_values.resize(discretization.locally_owned.n_elements());
  const std::size_t n_shapes = elements.empty() ? 0 : elements.front().nodes.size();
  block_offset.assign(elements.size() * n_shapes * n_shapes, -1);
  int n_entries = 0, *columns = nullptr;
  for (std::size_t row = 0; row < row_values.size(); ++row)
    matrix.ExtractMyRowView(static_cast<int>(row), n_entries, row_values[row], columns);
  std::size_t k = 0;
  for (const Element &element : elements)
    for (const int i : element.nodes)
    {
      const int row = owned_row[static_cast<std::size_t>(i)];
      double *unused;
      if (row >= 0)
        matrix.ExtractMyRowView(row, n_entries, unused, columns);
      for (const int j : element.nodes)
      {
        if (row >= 0 && !is_held[static_cast<std::size_t>(i)] &&
            !is_held[static_cast<std::size_t>(j)])
        {
          const int dof   = static_cast<int>(node_dofs[static_cast<std::size_t>(j)]);
          const int *from = std::find(columns, columns + n_entries, matrix.LCID(dof));
          if (from + 2 >= columns + n_entries || from[1] != matrix.LCID(dof + 1) ||
              from[2] != matrix.LCID(dof + 2))
            throw std::logic_error("the components of DoF " + std::to_string(dof) +
                                   " do not follow one another in the matrix");
          block_offset[k] = static_cast<int>(from - columns);
        }
        ++k;
      }
    }
}

/// Energy, residual and, where asked for, the matrix, whose tangent has `tension` added to its stress
/// (a fictitious isotropic one, for continuation; neither energy nor residual know of it).
template <int n_shapes>
ClothReference::State ClothReference::assemble(const Vector &positions, const Inertia &inertia,
                                               Vector &residual, const Tangent tangent,
                                               const double tension)
{
  using NodeVectors                 = Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor>;
  const ReferenceElement &reference = discretization.nonlinear_quadrature;
  Vector ghosted(discretization.locally_owned, discretization.locally_relevant,
                 discretization.communicator);
  Vector ghosted_centre(ghosted), ghosted_origin(ghosted);
  ghosted        = positions;
  ghosted_centre = inertia.centre;
  ghosted_origin = load_origin;
  // Values of the locally relevant DoFs stand in ascending order.
  const double *const x = ghosted.begin(), *const y = ghosted_centre.begin(),
                      *const x0 = ghosted_origin.begin();
  residual                      = 0.;
  double *const r               = residual.begin();
  if (tangent != Tangent::none)
  {
    solver->matrix = 0.;
    for (std::size_t node = 0; node < node_points.size(); ++node)
      if (owned_row[node] >= 0 && is_held[node]) // rows with their diagonal only
        for (int c = 0; c < 3; ++c)
          row_values[static_cast<std::size_t>(owned_row[node] + c)][0] = 1.;
  }
  const Eigen::Matrix<double, n_shapes, n_shapes> unit_mass = reference_mass;

  std::vector<double> sums(4, 0.); // energy, its size, force size², round off²
  std::size_t first_block = 0;
  for (const Element &element : elements)
  {
    NodeVectors at, from_centre, from_origin;
    for (int i = 0; i < n_shapes; ++i)
    {
      const std::size_t first =
        3 * static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(i)]);
      for (std::size_t c = 0; c < 3; ++c)
      {
        const int k       = static_cast<int>(c);
        at(i, k)          = x[first + c];
        from_centre(i, k) = x[first + c] - y[first + c];
        from_origin(i, k) = x[first + c] - x0[first + c];
      }
    }
    const Eigen::Matrix3d &C = stiffness_of_phase[static_cast<std::size_t>(element.phase)];
    const double mass_scale =
      0.5 * element.determinant * areal_density_of_phase[static_cast<std::size_t>(element.phase)];

    NodeVectors elastic = NodeVectors::Zero();
    Eigen::Matrix<double, 3 * n_shapes, 3 * n_shapes> K;
    if (tangent != Tangent::none)
      K.setZero();
    double stored = 0., steepest = 0.;
    for (std::size_t q = 0; q < reference.weights.size(); ++q)
    {
      Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor> gradients;
      for (int i = 0; i < n_shapes; ++i)
        gradients.row(i) =
          (element.inverse_transpose * reference.gradients[q][static_cast<std::size_t>(i)])
            .transpose();
      // From differences to the first node: cloth far from the origin keeps its digits.
      SpaceGradient F = SpaceGradient::Zero();
      for (int i = 1; i < n_shapes; ++i)
        F += (at.row(i) - at.row(0)).transpose() * gradients.row(i);
      const double weight       = reference.weights[q] * element.determinant;
      const SpaceResponse local = space_response(options.law, C, F, tangent);
      stored += weight * local.energy;
      elastic.noalias() += weight * gradients * local.stress.transpose();
      steepest = std::max(steepest, weight * gradients.rowwise().squaredNorm().maxCoeff());
      if (tangent == Tangent::none)
        continue;
      for (int j = 0; j < n_shapes; ++j)
      {
        Eigen::Matrix<double, 6, 3> times; // dP for a motion of node j along each axis
        for (int b = 0; b < 3; ++b)
          times.col(b) = weight * (local.tangent.col(2 * b) * gradients(j, 0) +
                                   local.tangent.col(2 * b + 1) * gradients(j, 1));
        for (int a = 0; a < 3; ++a)
        {
          times(2 * a, a) += weight * tension * gradients(j, 0);
          times(2 * a + 1, a) += weight * tension * gradients(j, 1);
        }
        for (int i = 0; i < n_shapes; ++i)
          for (int a = 0; a < 3; ++a)
            K.template block<1, 3>(3 * i + a, 3 * j) +=
              gradients(i, 0) * times.row(2 * a) + gradients(i, 1) * times.row(2 * a + 1);
      }
    }

    const NodeVectors accelerated = mass_scale * inertia.factor * (unit_mass * from_centre);
    const NodeVectors weights =
      mass_scale * (unit_mass * Eigen::Matrix<double, n_shapes, 1>::Ones()) * loads.gravity;
    const NodeVectors total = elastic + accelerated - weights;
    if (element.is_owned)
    {
      const double lifted   = weights.cwiseProduct(from_origin).sum();
      const double inertial = 0.5 * accelerated.cwiseProduct(from_centre).sum();
      sums[0] += stored + inertial - lifted;
      sums[1] += stored + inertial + weights.cwiseProduct(from_origin).cwiseAbs().sum();
      sums[2] += elastic.squaredNorm() + accelerated.squaredNorm() + weights.squaredNorm();
      const double rounding = machine_epsilon * at.cwiseAbs().maxCoeff() *
                              (steepest * C.diagonal().maxCoeff() + mass_scale * inertia.factor);
      sums[3] += rounding * rounding;
    }
    for (int i = 0; i < n_shapes; ++i)
    {
      const auto node = static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(i)]);
      if (owned_row[node] < 0 || is_held[node])
        continue;
      for (int c = 0; c < 3; ++c)
        r[owned_row[node] + c] += total(i, c);
    }
    if (tangent != Tangent::none)
      for (int i = 0; i < n_shapes; ++i)
      {
        const int row =
          owned_row[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(i)])];
        for (int j = 0; j < n_shapes; ++j)
        {
          const int offset = block_offset[first_block + static_cast<std::size_t>(n_shapes * i + j)];
          if (offset < 0)
            continue;
          const double mass = mass_scale * inertia.factor * unit_mass(i, j);
          for (int a = 0; a < 3; ++a)
          {
            double *const to = row_values[static_cast<std::size_t>(row + a)] + offset;
            for (int b = 0; b < 3; ++b)
              to[b] += K(3 * i + a, 3 * j + b) + (a == b ? mass : 0.);
          }
        }
      }
    first_block += n_shapes * n_shapes;
  }
  const std::vector<double> of_this_rank = sums;
  Utilities::MPI::sum(of_this_rank, discretization.communicator, sums);
  State state;
  state.energy      = sums[0];
  state.energy_size = sums[1];
  if (loads.body_force)
  {
    Vector moved = positions;
    moved -= load_origin;
    const double work = body_load * moved;
    residual.add(-1., body_load);
    state.energy -= work;
    state.energy_size += std::abs(work);
  }
  state.force_size = std::sqrt(sums[2]);
  state.round_off  = std::sqrt(sums[3]);
  state.residual   = residual.l2_norm();
  return state;
}

ClothReference::State ClothReference::evaluate(const Vector &positions, const Inertia &inertia,
                                               Vector &residual, const Tangent tangent,
                                               const double tension)
{
  return options.order == 1 ? assemble<3>(positions, inertia, residual, tangent, tension)
                            : assemble<6>(positions, inertia, residual, tangent, tension);
}

/// Conjugate gradients with the multigrid hierarchy of an earlier matrix, as long as that serves.
void ClothReference::solve_linearized(Vector &increment, const Vector &forces, const double target,
                                      ClothStep &step)
{
  const bool is_new = preconditioner_is_old || !solver->has_preconditioner();
  if (is_new)
    solver->build_preconditioner();
  // Should this solve fail, the next one has a hierarchy of its own.
  preconditioner_is_old = true;
  increment             = 0.;
  unsigned int used     = 0;
  try
  {
    used = solver->solve(increment, forces, target, most_linear_iterations);
  }
  catch (const meshes::NotConverged &failure)
  {
    step.n_linear += static_cast<unsigned int>(failure.residual_history().size());
    throw;
  }
  step.n_linear += used;
  const double digits    = std::max(0.5, std::log10(forces.l2_norm() / target));
  const double per_digit = (used + 1) / digits;
  if (is_new)
    iterations_per_digit_when_new = per_digit;
  preconditioner_is_old = per_digit > 1.5 * iterations_per_digit_when_new;
}

/// Newton's method from `positions`, in which the held nodes are where they belong.
/// @param tension of the continuation at its begin [N/m], 0 for none
/// @throws NotConverged
void ClothReference::minimize(Vector &positions, const Inertia &inertia, double tension,
                              ClothStep &step)
{
  Vector residual = solver->owned_vector(), increment = solver->owned_vector();
  Vector trial = positions, unused = solver->owned_vector();
  load_origin = positions;
  State state = evaluate(positions, inertia, residual, Tangent::none, 0.);
  std::vector<double> history;
  // Looser ones leave the soft motion along the normal, whose forces are small, to the next step.
  constexpr double largest_forcing = 0.01;
  double exact_below               = std::numeric_limits<double>::infinity();
  double forcing                   = largest_forcing;
  const unsigned int most_steps    = tension > 0. ? 200 : 60;
  while (true)
  {
    history.push_back(state.residual / (state.force_size > 0. ? state.force_size : 1.));
    step.relative_residual = history.back();
    if (!std::isfinite(state.residual) || !std::isfinite(state.energy))
      throw meshes::NotConverged("the forces are not finite", history);
    if (state.is_converged(options.tolerance))
      return;
    if (history.size() > most_steps)
      throw meshes::NotConverged(
        "Newton's method did not converge in " + std::to_string(most_steps) + " steps", history);

    const double target =
      std::max(0.3 * std::max(options.tolerance * state.force_size, state.round_off),
               forcing * state.residual);
    residual *= -1.;
    const Vector forces = residual;
    Tangent tangent     = state.residual < exact_below ? Tangent::exact : Tangent::positive;
    for (unsigned int attempt = 0;; ++attempt)
      try
      {
        evaluate(positions, inertia, unused, tangent, tension);
        solve_linearized(increment, forces, target, step);
        break;
      }
      catch (const meshes::NotConverged &)
      {
        if (attempt == 2)
          throw;
        // Negative curvature, or a hierarchy too old.
        if (tangent == Tangent::exact)
          exact_below = 0.1 * state.residual;
        tangent = Tangent::positive;
      }
    ++step.n_newton;
    step.n_projected += tangent == Tangent::positive;

    const double slope = -(forces * increment);
    double length      = 1.;
    State next;
    while (true)
    {
      trial = positions;
      trial.add(length, increment);
      next = evaluate(trial, inertia, residual, Tangent::none, 0.);
      if (next.energy <= state.energy + 1e-4 * length * slope)
        break;
      // Below the rounding of the energy the forces decide.
      if (std::abs(next.energy - state.energy) <= 1e-12 * next.energy_size &&
          next.residual < state.residual)
        break;
      length *= 0.5;
      if (length < 1e-4)
        throw meshes::NotConverged("the line search found no lower energy", history);
    }
    positions         = trial;
    const double fell = next.residual / state.residual;
    // As exact as the next step of Newton's method can use (Eisenstat and Walker 1996, choice 2).
    forcing = std::min(largest_forcing, std::max(1e-3, 0.9 * fell * fell));
    if (length == 1.)
      tension *= std::min(2., std::max(0.02, fell));
    state = next;
  }
}

void ClothReference::advance(const double dt, const unsigned int cuts, ClothStep &step)
{
  const double new_time = present_time + dt;
  try
  {
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
    ++step.n_parts;
  }
  catch (const meshes::NotConverged &failure)
  {
    step.why = failure.what();
    if (cuts == 6)
      throw;
    advance(0.5 * dt, cuts + 1, step);
    advance(0.5 * dt, cuts + 1, step);
  }
}

ClothStep ClothReference::step(const double dt)
{
  if (!(dt > 0.) || !std::isfinite(dt))
    throw meshes::BadInput("the time step is " + std::to_string(dt) +
                           " s; expected a positive number");
  Timer timer(discretization.communicator, true);
  ClothStep step;
  const Vector old_position = position, old_velocity = velocity;
  const double old_time = present_time;
  try
  {
    advance(dt, 0, step);
    present_time = old_time + dt;
    step.reached = true;
    step.why.clear();
    positions_at_vertices = at_vertices(position);
  }
  catch (const meshes::NotConverged &)
  {
    step.why     = "stopped at " + std::to_string(present_time) + " s: " + step.why;
    position     = old_position;
    velocity     = old_velocity;
    present_time = old_time;
  }
  timer.stop();
  step.seconds = Utilities::MPI::max(timer.wall_time(), discretization.communicator);
  return step;
}

ClothStep ClothReference::solve_equilibrium(const double time)
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

meshes::SpacePoints ClothReference::at_vertices(const Vector &values) const
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

const meshes::SpacePoints &ClothReference::positions() const
{
  return positions_at_vertices;
}

meshes::SpacePoints ClothReference::velocities() const
{
  return at_vertices(velocity);
}

double ClothReference::time() const
{
  return present_time;
}

FieldDistance ClothReference::distance_from(const KnownField &known) const
{
  return distance(discretization, position, known);
}

double ClothReference::stored_energy() const
{
  const ReferenceElement &reference = discretization.nonlinear_quadrature;
  Vector ghosted(discretization.locally_owned, discretization.locally_relevant,
                 discretization.communicator);
  ghosted               = position;
  const double *const x = ghosted.begin();
  double energy         = 0.;
  for (const Element &element : elements)
    if (element.is_owned)
      for (std::size_t q = 0; q < reference.weights.size(); ++q)
      {
        SpaceGradient F = SpaceGradient::Zero();
        for (std::size_t i = 0; i < element.nodes.size(); ++i)
          F += Eigen::Map<const Eigen::Vector3d>(x + 3 * element.nodes[i]) *
               (element.inverse_transpose * reference.gradients[q][i]).transpose();
        energy +=
          reference.weights[q] * element.determinant *
          space_response(options.law, stiffness_of_phase[static_cast<std::size_t>(element.phase)],
                         F, Tangent::none)
            .energy;
      }
  return Utilities::MPI::sum(energy, discretization.communicator);
}

double ClothReference::kinetic_energy() const
{
  Vector ghosted(discretization.locally_owned, discretization.locally_relevant,
                 discretization.communicator);
  ghosted               = velocity;
  const double *const v = ghosted.begin();
  double energy         = 0.;
  for (const Element &element : elements)
    if (element.is_owned)
    {
      Eigen::Matrix<double, Eigen::Dynamic, 3> of_nodes(element.nodes.size(), 3);
      for (std::size_t i = 0; i < element.nodes.size(); ++i)
        of_nodes.row(static_cast<Eigen::Index>(i)) =
          Eigen::Map<const Eigen::RowVector3d>(v + 3 * element.nodes[i]);
      energy += 0.25 * element.determinant *
                areal_density_of_phase[static_cast<std::size_t>(element.phase)] *
                of_nodes.cwiseProduct(reference_mass * of_nodes).sum();
    }
  return Utilities::MPI::sum(energy, discretization.communicator);
}
} // namespace homespun::verification
