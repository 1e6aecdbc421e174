// SPDX-License-Identifier: MIT
// The element loops of the resolved cloth: residual, matrix and energies.
#include "verification/reference/cloth_reference_solver.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace homespun::verification
{
using namespace dealii;
using homogenization::ElasticSolver;

namespace
{
constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

/// A field in space at the nodes of a triangle, one per row.
using FieldAtNodes = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Of a field at the nodes of a cell, node after node.
Eigen::Map<const FieldAtNodes> at_nodes(const std::vector<double> &values)
{
  return {values.data(), static_cast<Eigen::Index>(values.size() / 3), 3};
}

ElasticSolver::Vector ghosted(const homogenization::Discretization &discretization,
                              const ElasticSolver::Vector &field)
{
  ElasticSolver::Vector result(discretization.locally_owned, discretization.locally_active,
                               discretization.communicator);
  result = field;
  return result;
}

/// Sum over all cells of all ranks of what each gives from a field at its nodes.
template <typename OfCell>
double sum_over_cells(const homogenization::Discretization &discretization,
                      const ElasticSolver::Vector &field, const OfCell &of_cell)
{
  FEValues<2> fe_values = discretization.gradients_of_nodes(discretization.nonlinear_quadrature);
  const ElasticSolver::Vector everywhere = ghosted(discretization, field);
  std::vector<double> values(discretization.element.n_dofs_per_cell());
  double sum = 0.;
  discretization.for_owned_cells(
    [&](const auto &cell, const std::vector<types::global_dof_index> &dofs)
    {
      fe_values.reinit(discretization.on_mesh(cell));
      everywhere.extract_subvector_to(dofs, values);
      sum += of_cell(fe_values, cell->material_id(), at_nodes(values));
    });
  return Utilities::MPI::sum(sum, discretization.communicator);
}

double area_of(const FEValues<2> &fe_values)
{
  const std::vector<double> &weights = fe_values.get_JxW_values();
  return std::accumulate(weights.begin(), weights.end(), 0.);
}

template <int n_shapes>
Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor> gradients_of(const FEValues<2> &fe_values,
                                                                 const unsigned int q)
{
  Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor> gradients;
  for (unsigned int i = 0; i < n_shapes; ++i)
    for (unsigned int d = 0; d < 2; ++d)
      gradients(i, d) = fe_values.shape_grad(i, q)[d];
  return gradients;
}
} // namespace

void ClothReference::Solver::lay_out_matrix()
{
  solver.reset(); // before its constraints change
  constraints.clear();
  constraints.reinit(discretization.locally_active);
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (is_held[node])
      for (unsigned int c = 0; c < 3; ++c)
        constraints.add_line(nodes[node].first_dof + c);
  constraints.close();
  solver = std::make_unique<ElasticSolver>(discretization, constraints);
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
ClothReference::Solver::integrate(const FEValues<2> &fe_values, const Eigen::Matrix3d &C,
                                  const Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor> &at,
                                  const Tangent tangent, const double tension) const
{
  ElasticSums<n_shapes> sums;
  if (tangent != Tangent::none)
    sums.K.setZero();
  for (const unsigned int q : fe_values.quadrature_point_indices())
  {
    const auto gradients = gradients_of<n_shapes>(fe_values, q);
    // From differences to the first node: cloth far from the origin keeps its digits.
    SpaceGradient F = SpaceGradient::Zero();
    for (int i = 1; i < n_shapes; ++i)
      F += (at.row(i) - at.row(0)).transpose() * gradients.row(i);
    const double weight       = fe_values.JxW(q);
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

/// Energy, residual and, where asked for, the matrix, whose tangent has `tension` added to its
/// stress (a fictitious isotropic one, for continuation; neither energy nor residual know of it).
template <int n_shapes>
ClothReference::Solver::Evaluation
ClothReference::Solver::assemble(const Vector &positions, const Inertia &inertia, Vector &residual,
                                 const Tangent tangent, const double tension)
{
  using NodeVectors       = Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor>;
  constexpr int n         = 3 * n_shapes;
  const Vector everywhere = ghosted(discretization, positions),
               centre     = ghosted(discretization, inertia.centre),
               origin     = ghosted(discretization, load_origin);
  residual                = 0.;
  if (tangent != Tangent::none)
    solver->matrix = 0.;
  const Eigen::Matrix<double, n_shapes, n_shapes> unit_mass = reference_mass;

  std::vector<double> sums(4, 0.); // energy, its size, force size², round off²
  FEValues<2> fe_values = discretization.gradients_of_nodes(discretization.nonlinear_quadrature);
  std::vector<double> values(n);
  FullMatrix<double> cell_matrix(n, n);
  dealii::Vector<double> cell_forces(n);
  discretization.for_owned_cells(
    [&](const auto &cell, const std::vector<types::global_dof_index> &dofs)
    {
      fe_values.reinit(discretization.on_mesh(cell));
      const auto of_field = [&](const Vector &field) -> NodeVectors
      {
        field.extract_subvector_to(dofs, values);
        return at_nodes(values);
      };
      const NodeVectors at = of_field(everywhere), from_centre = at - of_field(centre),
                        from_origin = at - of_field(origin);
      const Eigen::Matrix3d &C      = stiffness_of_phase[cell->material_id()];
      const double mass_scale = area_of(fe_values) * areal_density_of_phase[cell->material_id()];

      const ElasticSums<n_shapes> sums_of_element =
        integrate<n_shapes>(fe_values, C, at, tangent, tension);
      const NodeVectors &elastic    = sums_of_element.forces;
      const NodeVectors accelerated = mass_scale * inertia.factor * (unit_mass * from_centre);
      const NodeVectors weights =
        mass_scale * (unit_mass * Eigen::Matrix<double, n_shapes, 1>::Ones()) * loads.gravity;
      const NodeVectors total = elastic + accelerated - weights;
      const double lifted     = weights.cwiseProduct(from_origin).sum();
      const double inertial   = 0.5 * accelerated.cwiseProduct(from_centre).sum();
      sums[0] += sums_of_element.energy + inertial - lifted;
      sums[1] +=
        sums_of_element.energy + inertial + weights.cwiseProduct(from_origin).cwiseAbs().sum();
      sums[2] += elastic.squaredNorm() + accelerated.squaredNorm() + weights.squaredNorm();
      const double rounding =
        machine_epsilon * at.cwiseAbs().maxCoeff() *
        (sums_of_element.steepest * C.diagonal().maxCoeff() + mass_scale * inertia.factor);
      sums[3] += rounding * rounding;
      std::copy(total.data(), total.data() + n, cell_forces.begin());
      constraints.distribute_local_to_global(cell_forces, dofs, residual);
      if (tangent == Tangent::none)
        return;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          cell_matrix(static_cast<unsigned int>(i), static_cast<unsigned int>(j)) =
            sums_of_element.K(i, j) +
            (i % 3 == j % 3 ? mass_scale * inertia.factor * unit_mass(i / 3, j / 3) : 0.);
      constraints.distribute_local_to_global(cell_matrix, dofs, solver->matrix);
    });
  residual.compress(VectorOperation::add);
  if (tangent != Tangent::none)
    solver->matrix.compress(VectorOperation::add);
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
  return sum_over_cells(
    discretization, position,
    [&](const FEValues<2> &fe_values, const std::size_t phase, const auto &at)
    {
      double energy = 0.;
      for (const unsigned int q : fe_values.quadrature_point_indices())
      {
        SpaceGradient F = SpaceGradient::Zero();
        for (Eigen::Index i = 0; i < at.rows(); ++i)
        {
          const Tensor<1, 2> &slope = fe_values.shape_grad(static_cast<unsigned int>(i), q);
          F += at.row(i).transpose() * Eigen::RowVector2d(slope[0], slope[1]);
        }
        energy += fe_values.JxW(q) *
                  space_response(options.law, stiffness_of_phase[phase], F, Tangent::none).energy;
      }
      return energy;
    });
}

double ClothReference::Solver::kinetic_energy() const
{
  return sum_over_cells(discretization, velocity,
                        [&](const FEValues<2> &fe_values, const std::size_t phase, const auto &at)
                        {
                          return 0.5 * area_of(fe_values) * areal_density_of_phase[phase] *
                                 at.cwiseProduct(reference_mass * at).sum();
                        });
}
} // namespace homespun::verification
