// SPDX-License-Identifier: MIT
// The element loops of the resolved cloth: residual, matrix and energies.
#include "verification/reference/cloth_reference_solver.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace homespun::verification
{
using namespace dealii;
using homogenization::ElasticSolver;
using homogenization::ReferenceElement;

namespace
{
constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

/// A field in space at the nodes of a triangle, one per row.
using FieldAtNodes = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Sum over all triangles of all ranks of what each gives from a field at its nodes.
template <typename Element, typename OfTriangle>
double sum_over_triangles(const homogenization::Discretization &discretization,
                          const std::vector<Element> &elements, const ElasticSolver::Vector &field,
                          const OfTriangle &of_triangle)
{
  ElasticSolver::Vector ghosted(discretization.locally_owned, discretization.locally_relevant,
                                discretization.communicator);
  ghosted                    = field;
  const double *const values = ghosted.begin();
  double sum                 = 0.;
  for (const Element &element : elements)
    if (element.is_owned)
    {
      FieldAtNodes at(element.nodes.size(), 3);
      for (std::size_t i = 0; i < element.nodes.size(); ++i)
        at.row(static_cast<Eigen::Index>(i)) =
          Eigen::Map<const Eigen::RowVector3d>(values + 3 * element.nodes[i]);
      sum += of_triangle(element, at);
    }
  return Utilities::MPI::sum(sum, discretization.communicator);
}
} // namespace

/// The matrix, and where each 3x3 block of each element goes in the rows of this rank, so that an
/// assembly need not search for it.
void ClothReference::Solver::lay_out_matrix()
{
  solver.reset(); // before its constraints change
  constraints.clear();
  constraints.reinit(discretization.locally_relevant);
  for (std::size_t node = 0; node < node_points.size(); ++node)
    if (is_held[node])
      for (unsigned int c = 0; c < 3; ++c)
        constraints.add_line(node_dofs[node] + c);
  constraints.close();
  solver = std::make_unique<ElasticSolver>(discretization, constraints);

  row_values.resize(discretization.locally_owned.n_elements());
  const std::size_t n_shapes = elements.empty() ? 0 : elements.front().nodes.size();
  block_offset.assign(elements.size() * n_shapes * n_shapes, -1);
  for (std::size_t row = 0; row < row_values.size(); ++row)
    row_values[row] = solver->matrix_row(static_cast<int>(row)).values;
  ElasticSolver::MatrixRow stored;
  std::size_t k = 0;
  for (const Element &element : elements)
    for (const int i : element.nodes)
    {
      const int row = owned_row[static_cast<std::size_t>(i)];
      if (row >= 0)
        stored = solver->matrix_row(row);
      for (const int j : element.nodes)
      {
        if (row >= 0 && !is_held[static_cast<std::size_t>(i)] &&
            !is_held[static_cast<std::size_t>(j)])
        {
          const int dof   = static_cast<int>(node_dofs[static_cast<std::size_t>(j)]);
          const int *end  = stored.columns + stored.n,
                    *from = std::find(stored.columns, end, solver->local_column(dof));
          if (from + 2 >= end || from[1] != solver->local_column(dof + 1) ||
              from[2] != solver->local_column(dof + 2))
            throw std::logic_error("the components of DoF " + std::to_string(dof) +
                                   " do not follow one another in the matrix");
          block_offset[k] = static_cast<int>(from - stored.columns);
        }
        ++k;
      }
    }
}

/// What the membrane of one triangle gives.
template <int n_shapes>
struct ClothReference::Solver::ElasticSums
{
  double energy = 0.; ///< [J]
  Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor> forces =
    Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor>::Zero();
  Eigen::Matrix<double, 3 * n_shapes, 3 * n_shapes> K;
  double steepest = 0.; ///< weight times the largest |grad v|^2
};

template <int n_shapes>
ClothReference::Solver::ElasticSums<n_shapes>
ClothReference::Solver::integrate(const Element &element, const Eigen::Matrix3d &C,
                                  const Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor> &at,
                                  const Tangent tangent, const double tension) const
{
  const ReferenceElement &reference = discretization.nonlinear_quadrature;
  ElasticSums<n_shapes> sums;
  if (tangent != Tangent::none)
    sums.K.setZero();
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
    sums.energy += weight * local.energy;
    sums.forces.noalias() += weight * gradients * local.stress.transpose();
    sums.steepest = std::max(sums.steepest, weight * gradients.rowwise().squaredNorm().maxCoeff());
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
          sums.K.template block<1, 3>(3 * i + a, 3 * j) +=
            gradients(i, 0) * times.row(2 * a) + gradients(i, 1) * times.row(2 * a + 1);
    }
  }
  return sums;
}

/// Adds the blocks of one triangle to the matrix.
/// @param offsets of its blocks in the rows of this rank
/// @param inertia by which its mass of unit density counts
template <int n_shapes>
void ClothReference::Solver::add_blocks(const Element &element, const int *const offsets,
                                        const Eigen::Matrix<double, 3 * n_shapes, 3 * n_shapes> &K,
                                        const double inertia)
{
  for (int i = 0; i < n_shapes; ++i)
  {
    const int row = owned_row[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(i)])];
    for (int j = 0; j < n_shapes; ++j)
    {
      const int offset = offsets[n_shapes * i + j];
      if (offset < 0)
        continue;
      const double mass = inertia * reference_mass(i, j);
      for (int a = 0; a < 3; ++a)
      {
        double *const to = row_values[static_cast<std::size_t>(row + a)] + offset;
        for (int b = 0; b < 3; ++b)
          to[b] += K(3 * i + a, 3 * j + b) + (a == b ? mass : 0.);
      }
    }
  }
}

/// A zero matrix, but for the rows of held nodes, which have their diagonal only.
void ClothReference::Solver::clear_matrix()
{
  solver->matrix = 0.;
  for (std::size_t node = 0; node < node_points.size(); ++node)
    if (owned_row[node] >= 0 && is_held[node])
      for (int c = 0; c < 3; ++c)
        row_values[static_cast<std::size_t>(owned_row[node] + c)][0] = 1.;
}

/// Energy, residual and, where asked for, the matrix, whose tangent has `tension` added to its
/// stress (a fictitious isotropic one, for continuation; neither energy nor residual know of it).
template <int n_shapes>
ClothReference::Solver::Evaluation
ClothReference::Solver::assemble(const Vector &positions, const Inertia &inertia, Vector &residual,
                                 const Tangent tangent, const double tension)
{
  using NodeVectors = Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor>;
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
    clear_matrix();
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

    const ElasticSums<n_shapes> sums_of_element =
      integrate<n_shapes>(element, C, at, tangent, tension);
    const NodeVectors &elastic    = sums_of_element.forces;
    const NodeVectors accelerated = mass_scale * inertia.factor * (unit_mass * from_centre);
    const NodeVectors weights =
      mass_scale * (unit_mass * Eigen::Matrix<double, n_shapes, 1>::Ones()) * loads.gravity;
    const NodeVectors total = elastic + accelerated - weights;
    if (element.is_owned)
    {
      const double lifted   = weights.cwiseProduct(from_origin).sum();
      const double inertial = 0.5 * accelerated.cwiseProduct(from_centre).sum();
      sums[0] += sums_of_element.energy + inertial - lifted;
      sums[1] +=
        sums_of_element.energy + inertial + weights.cwiseProduct(from_origin).cwiseAbs().sum();
      sums[2] += elastic.squaredNorm() + accelerated.squaredNorm() + weights.squaredNorm();
      const double rounding =
        machine_epsilon * at.cwiseAbs().maxCoeff() *
        (sums_of_element.steepest * C.diagonal().maxCoeff() + mass_scale * inertia.factor);
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
      add_blocks<n_shapes>(element, &block_offset[first_block], sums_of_element.K,
                           mass_scale * inertia.factor);
    first_block += n_shapes * n_shapes;
  }
  return summed(std::move(sums), positions, residual);
}

/// An evaluation from the sums over the elements of this rank, with what the body force adds.
/// @param sums energy, its size, force size squared, round-off squared
ClothReference::Solver::Evaluation ClothReference::Solver::summed(std::vector<double> sums,
                                                                  const Vector &positions,
                                                                  Vector &residual) const
{
  const std::vector<double> of_this_rank = sums;
  Utilities::MPI::sum(of_this_rank, discretization.communicator, sums);
  Evaluation state;
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

ClothReference::Solver::Evaluation
ClothReference::Solver::evaluate(const Vector &positions, const Inertia &inertia, Vector &residual,
                                 const Tangent tangent, const double tension)
{
  return options.order == 1 ? assemble<3>(positions, inertia, residual, tangent, tension)
                            : assemble<6>(positions, inertia, residual, tangent, tension);
}

double ClothReference::Solver::stored_energy() const
{
  const ReferenceElement &reference = discretization.nonlinear_quadrature;
  return sum_over_triangles(
    discretization, elements, position,
    [&](const Element &element, const FieldAtNodes &at)
    {
      double energy = 0.;
      for (std::size_t q = 0; q < reference.weights.size(); ++q)
      {
        SpaceGradient F = SpaceGradient::Zero();
        for (std::size_t i = 0; i < element.nodes.size(); ++i)
          F += at.row(static_cast<Eigen::Index>(i)).transpose() *
               (element.inverse_transpose * reference.gradients[q][i]).transpose();
        energy +=
          reference.weights[q] * element.determinant *
          space_response(options.law, stiffness_of_phase[static_cast<std::size_t>(element.phase)],
                         F, Tangent::none)
            .energy;
      }
      return energy;
    });
}

double ClothReference::Solver::kinetic_energy() const
{
  return sum_over_triangles(
    discretization, elements, velocity,
    [&](const Element &element, const FieldAtNodes &at)
    {
      return 0.25 * element.determinant *
             areal_density_of_phase[static_cast<std::size_t>(element.phase)] *
             at.cwiseProduct(reference_mass * at).sum();
    });
}
} // namespace homespun::verification
