// SPDX-License-Identifier: MIT
// The element loops of the resolved cloth: residual, matrix and energies.
#include "verification/reference/cloth_reference_solver.h"
#include "verification/reference/element_stiffness.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
using namespace dealii;
using homogenization::ElasticSolver;

namespace
{
constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

template <int n_shapes>
using NodeVectors = Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor>;
} // namespace

void ClothReference::Solver::lay_out_matrix()
{
  cells.reset(); // before its matrix, and that before its constraints change
  solver.reset();
  constraints.clear();
  constraints.reinit(discretization.locally_active);
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (is_held[node])
      for (unsigned int c = 0; c < 3; ++c)
        constraints.add_line(nodes[node].first_dof + c);
  constraints.close();
  solver = std::make_unique<ElasticSolver>(discretization, constraints);
  cells  = std::make_unique<homogenization::CellEntries>(discretization, constraints, *solver);
}

/// What the membrane of one triangle gives.
template <int n_shapes>
struct ClothReference::Solver::ElasticSums
{
  double energy                = 0.; ///< [J]
  NodeVectors<n_shapes> forces = NodeVectors<n_shapes>::Zero();
  ElementStiffness<3, n_shapes> K;
  double steepest = 0.; ///< weight times the largest |grad v|^2
};

template <int n_shapes>
ClothReference::Solver::ElasticSums<n_shapes>
ClothReference::Solver::integrate(const homogenization::NodeGradients &gradients,
                                  const Eigen::Matrix3d &C,
                                  const Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor> &at,
                                  const Tangent tangent, const double tension) const
{
  ElasticSums<n_shapes> sums;
  if (tangent != Tangent::none)
    sums.K.setZero();
  for (int q = 0; q < gradients.n_points(); ++q)
  {
    const auto slopes   = gradients.at<n_shapes>(q);
    const double weight = gradients.weight(q);
    // From differences to the first node: cloth far from the origin keeps its digits.
    SpaceGradient F = SpaceGradient::Zero();
    for (int i = 1; i < n_shapes; ++i)
      F += (at.row(i) - at.row(0)).transpose() * slopes.row(i);
    const SpaceResponse local = space_response(options.law, C, F, tangent);
    sums.energy += weight * local.energy;
    sums.forces += weight * slopes.lazyProduct(local.stress.transpose());
    sums.steepest = std::max(sums.steepest, weight * slopes.rowwise().squaredNorm().maxCoeff());
    if (tangent != Tangent::none)
      add_stiffness<3, n_shapes>(local.tangent + tension * SpaceTangent::Identity(), slopes, weight,
                                 sums.K);
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
  constexpr int n         = 3 * n_shapes;
  const Vector everywhere = cells->with_ghosts(positions),
               centre     = cells->with_ghosts(inertia.centre),
               origin     = cells->with_ghosts(load_origin);
  residual                = 0.;
  if (tangent != Tangent::none)
    solver->matrix = 0.;
  const Eigen::Matrix<double, n_shapes, n_shapes> unit_mass = reference_mass;

  std::vector<double> sums(4, 0.); // energy, its size, force size², round off²
  homogenization::NodeGradients gradients(discretization, discretization.nonlinear_quadrature);
  for (int cell = 0; cell < cells->n_cells(); ++cell)
  {
    gradients.reinit(cells->triangle(cell));
    const NodeVectors<n_shapes> at          = cells->values<n_shapes, 3>(everywhere, cell),
                                from_centre = at - cells->values<n_shapes, 3>(centre, cell),
                                from_origin = at - cells->values<n_shapes, 3>(origin, cell);
    const std::size_t phase                 = phase_of(cell);
    const Eigen::Matrix3d &C                = stiffness_of_phase[phase];
    const double mass_scale                 = gradients.area() * areal_density_of_phase[phase];

    ElasticSums<n_shapes> sums_of_element = integrate<n_shapes>(gradients, C, at, tangent, tension);
    const NodeVectors<n_shapes> &elastic  = sums_of_element.forces;
    const NodeVectors<n_shapes> accelerated =
      mass_scale * inertia.factor * (unit_mass * from_centre);
    const NodeVectors<n_shapes> weights =
      mass_scale * (unit_mass * Eigen::Matrix<double, n_shapes, 1>::Ones()) * loads.gravity;
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
    cells->add<n_shapes, 3>(elastic + accelerated - weights, cell, residual);
    if (tangent == Tangent::none)
      continue;
    for (int i = 0; i < n; ++i)
      for (int j = i % 3; j < n; j += 3)
        sums_of_element.K(i, j) += mass_scale * inertia.factor * unit_mass(i / 3, j / 3);
    cells->add<n_shapes, 3>(sums_of_element.K, cell);
  }
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

/// Sum over all cells of all ranks of what each gives from a field at its nodes.
template <typename OfCell>
double ClothReference::Solver::sum_over_cells(const Vector &field, const OfCell &of_cell) const
{
  const Vector everywhere = cells->with_ghosts(field);
  homogenization::NodeGradients gradients(discretization, discretization.nonlinear_quadrature);
  double sum = 0.;
  for (int cell = 0; cell < cells->n_cells(); ++cell)
  {
    gradients.reinit(cells->triangle(cell));
    const std::size_t phase = phase_of(cell);
    sum += options.order == 1 ? of_cell(gradients, phase, cells->values<3, 3>(everywhere, cell))
                              : of_cell(gradients, phase, cells->values<6, 3>(everywhere, cell));
  }
  return Utilities::MPI::sum(sum, discretization.communicator);
}

double ClothReference::Solver::stored_energy() const
{
  return sum_over_cells(
    position, [&](const auto &gradients, const std::size_t phase, const auto &at)
    { return integrate(gradients, stiffness_of_phase[phase], at, Tangent::none, 0.).energy; });
}

double ClothReference::Solver::kinetic_energy() const
{
  return sum_over_cells(velocity,
                        [&](const auto &gradients, const std::size_t phase, const auto &at)
                        {
                          return 0.5 * gradients.area() * areal_density_of_phase[phase] *
                                 at.cwiseProduct(reference_mass * at).sum();
                        });
}

std::size_t ClothReference::Solver::phase_of(const int cell) const
{
  return static_cast<std::size_t>(discretization.mesh.material(cells->triangle(cell)));
}
} // namespace homespun::verification
