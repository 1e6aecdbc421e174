// SPDX-License-Identifier: MIT
// Energy, forces and tangent of a resolved sheet.
#include "homogenization/fem/node_gradients.h"
#include "verification/reference/element_stiffness.h"
#include "verification/reference/fine_reference_solver.h"

#include <deal.II/base/mpi.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
using namespace dealii;

namespace
{
/// By more than round-off: a rotation has none of its own at rest.
bool has_negative_eigenvalue(const Eigen::Matrix4d &tangent, const Eigen::Matrix3d &C)
{
  const double round_off = 1e-12 * C.cwiseAbs().maxCoeff();
  return (tangent + round_off * Eigen::Matrix4d::Identity()).llt().info() != Eigen::Success;
}
} // namespace

/// What one triangle adds to matrix and forces.
template <int n_shapes>
struct FineReference::Solver::TriangleSums
{
  ElementStiffness<2, n_shapes> K = ElementStiffness<2, n_shapes>::Zero();
  Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor> f =
    Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor>::Zero();
  bool is_inverted = false, is_indefinite = false;
};

template <int n_shapes>
FineReference::Solver::TriangleSums<n_shapes> FineReference::Solver::integrate(
  const homogenization::NodeGradients &gradients, const LawOfPhase &phase,
  const Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor> &displacements,
  const Eigen::Matrix2d &mean_gradient, const Tangent tangent, Evaluation &state) const
{
  const Eigen::Matrix3d &C = phase.stiffness();
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double rounded     = epsilon * C.cwiseAbs().maxCoeff();
  TriangleSums<n_shapes> sums;
  for (int q = 0; q < gradients.n_points(); ++q)
  {
    const auto slopes       = gradients.at<n_shapes>(q);
    const double weight     = gradients.weight(q);
    const Eigen::Matrix2d F = mean_gradient + displacements.transpose().lazyProduct(slopes).eval();
    // Of the sum that F is.
    const double size_of_terms =
      mean_gradient.norm() +
      (displacements.rowwise().norm().array() * slopes.rowwise().norm().array()).sum();
    if (!(F.determinant() > 0.))
    {
      sums.is_inverted = true;
      if (law == Law::green)
        state.energy = std::numeric_limits<double>::infinity();
    }
    state.round_off += slopes.squaredNorm() * std::pow(weight * rounded * size_of_terms, 2);
    const Response local = phase.response(F);
    const Eigen::Matrix2d stress =
      weight * Eigen::Map<const Eigen::Matrix2d>(local.stress.data()).transpose();
    state.energy += weight * local.energy;
    state.energy_round_off += stress.norm() * epsilon * size_of_terms;
    sums.f += slopes.lazyProduct(stress.transpose());
    state.forces.stress += stress;
    if (tangent == Tangent::none)
      continue;
    // Most triangles have no negative part, which is cheaper to see than to take out.
    const bool is_indefinite = has_negative_eigenvalue(local.tangent, C);
    sums.is_indefinite       = sums.is_indefinite || is_indefinite;
    add_stiffness<2, n_shapes>(
      is_indefinite && tangent == Tangent::projected ? positive_part(local.tangent) : local.tangent,
      slopes, weight, sums.K);
  }
  return sums;
}

template <int n_shapes>
FineReference::Solver::Evaluation
FineReference::Solver::assemble(const Vector &displacement, const Eigen::Matrix2d &mean_gradient,
                                Vector &residual, const Tangent tangent)
{
  const Vector everywhere = cells->with_ghosts(displacement);
  residual                = 0.;
  if (tangent != Tangent::none)
    solver->matrix = 0.;

  Evaluation state;
  homogenization::NodeGradients gradients(discretization, law == Law::linear
                                                            ? discretization.stiffness_quadrature
                                                            : discretization.nonlinear_quadrature);
  for (int cell = 0; cell < cells->n_cells(); ++cell)
  {
    const int t = cells->triangle(cell);
    gradients.reinit(t);
    const TriangleSums<n_shapes> sums = integrate<n_shapes>(
      gradients, phases[static_cast<std::size_t>(discretization.mesh.material(t))],
      cells->values<n_shapes, 2>(everywhere, cell), mean_gradient, tangent, state);
    state.n_inverted += sums.is_inverted;
    state.n_indefinite += sums.is_indefinite;
    state.force_size += sums.f.squaredNorm();
    cells->add(sums.f, cell, residual);
    if (tangent != Tangent::none)
      cells->add<n_shapes, 2>(sums.K, cell);
    for (int k = 0; k < n_shapes && !cells->is_plain(cell); ++k)
      if (const auto held = clamp_of_node.find(cells->first_dof(cell, k));
          held != clamp_of_node.end())
        state.forces.on_clamps.row(held->second) += sums.f.row(k);
  }
  residual.compress(VectorOperation::add);
  if (tangent != Tangent::none)
    solver->matrix.compress(VectorOperation::add);
  add_over_ranks(state);
  if (body_force)
  {
    residual.add(-1., body_load);
    state.energy -= body_load * displacement;
  }
  state.residual = residual.l2_norm();
  return state;
}

/// Sums of squares become norms.
void FineReference::Solver::add_over_ranks(Evaluation &state) const
{
  const auto sum = [&](auto &part)
  { part = Utilities::MPI::sum(part, discretization.communicator); };
  for (double *const part :
       {&state.energy, &state.energy_round_off, &state.force_size, &state.round_off})
    sum(*part);
  for (unsigned int *const part : {&state.n_inverted, &state.n_indefinite})
    sum(*part);
  state.force_size = std::sqrt(state.force_size);
  state.round_off  = std::sqrt(state.round_off);
  state.forces.stress /= std::abs(sheet.sides().determinant());
  for (Eigen::Matrix2d *const part : {&state.forces.on_clamps, &state.forces.stress})
    MPI_Allreduce(MPI_IN_PLACE, part->data(), 4, MPI_DOUBLE, MPI_SUM, discretization.communicator);
}

FineReference::Solver::Evaluation
FineReference::Solver::evaluate(const Vector &displacement, const Eigen::Matrix2d &mean_gradient,
                                Vector &residual, const Tangent tangent)
{
  return options.order == 1 ? assemble<3>(displacement, mean_gradient, residual, tangent)
                            : assemble<6>(displacement, mean_gradient, residual, tangent);
}
} // namespace homespun::verification
