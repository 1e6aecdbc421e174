// SPDX-License-Identifier: MIT
// Energy, forces and tangent of a resolved sheet.
#include "meshes/plain/errors.h"
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

/// Adds w D^T T D. Coefficient by coefficient, for Eigen packs the operands of a product of this
/// size, which takes longer than the product.
template <int n>
void add_tangent(const Eigen::Matrix4d &tangent, const Eigen::Matrix<double, 4, n> &D,
                 const double weight, Eigen::Matrix<double, n, n> &K)
{
  const Eigen::Matrix4d weighted          = weight * tangent;
  const Eigen::Matrix<double, 4, n> force = weighted.lazyProduct(D);
  K += D.transpose().lazyProduct(force);
}
/// Of the shape of one node.
Eigen::Vector2d gradient_of(const FEValues<2> &fe_values, const unsigned int node,
                            const unsigned int q)
{
  const Tensor<1, 2> &gradient = fe_values.shape_grad(node, q);
  return {gradient[0], gradient[1]};
}
} // namespace

/// What one triangle adds to matrix and forces.
template <int n_shapes>
struct FineReference::Solver::TriangleSums
{
  static constexpr int n        = 2 * n_shapes;
  Eigen::Matrix<double, n, n> K = Eigen::Matrix<double, n, n>::Zero();
  Eigen::Matrix<double, n, 1> f = Eigen::Matrix<double, n, 1>::Zero();
  bool is_inverted = false, is_indefinite = false;
};

template <int n_shapes>
FineReference::Solver::TriangleSums<n_shapes> FineReference::Solver::integrate(
  const FEValues<2> &fe_values, const LawOfPhase &phase, const std::vector<double> &values,
  const Eigen::Matrix2d &mean_gradient, const Tangent tangent, Evaluation &state) const
{
  constexpr int n          = 2 * n_shapes;
  const Eigen::Matrix3d &C = phase.stiffness();
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double rounded     = epsilon * C.cwiseAbs().maxCoeff();
  TriangleSums<n_shapes> sums;
  for (const unsigned int q : fe_values.quadrature_point_indices())
  {
    // D maps the displacements of the nodes to the entries F11, F12, F21, F22 of grad u.
    Eigen::Matrix<double, 4, n> D = Eigen::Matrix<double, 4, n>::Zero();
    Eigen::Matrix2d F             = mean_gradient;
    double size_of_terms = F.norm(), slopes = 0.; // of the sum that F is, and |grad v|^2
    for (int i = 0; i < n_shapes; ++i)
    {
      const auto k                     = static_cast<std::size_t>(i);
      const Eigen::Vector2d g          = gradient_of(fe_values, static_cast<unsigned int>(i), q);
      D.template block<2, 1>(0, 2 * i) = g;
      D.template block<2, 1>(2, 2 * i + 1) = g;
      F.row(0) += values[2 * k] * g.transpose();
      F.row(1) += values[2 * k + 1] * g.transpose();
      size_of_terms += Eigen::Vector2d(values[2 * k], values[2 * k + 1]).norm() * g.norm();
      slopes += g.squaredNorm();
    }
    const double weight = fe_values.JxW(q);
    if (!(F.determinant() > 0.))
    {
      sums.is_inverted = true;
      if (law == Law::green)
        state.energy = std::numeric_limits<double>::infinity();
    }
    state.round_off += slopes * std::pow(weight * rounded * size_of_terms, 2);
    const Response local = phase.response(F);
    state.energy += weight * local.energy;
    state.energy_round_off += weight * local.stress.norm() * epsilon * size_of_terms;
    sums.f.noalias() += weight * D.transpose() * local.stress;
    state.forces.stress +=
      weight * Eigen::Map<const Eigen::Matrix2d>(local.stress.data()).transpose();
    if (tangent == Tangent::exact)
    {
      sums.is_indefinite = sums.is_indefinite || has_negative_eigenvalue(local.tangent, C);
      add_tangent(local.tangent, D, weight, sums.K);
    }
    else if (tangent == Tangent::projected)
    {
      // Most triangles have no negative part, which is cheaper to see than to take out.
      const Eigen::Matrix4d positive =
        has_negative_eigenvalue(local.tangent, C) ? positive_part(local.tangent) : local.tangent;
      add_tangent(positive, D, weight, sums.K);
    }
  }
  return sums;
}

template <int n_shapes>
FineReference::Solver::Evaluation
FineReference::Solver::assemble(const Vector &displacement, const Eigen::Matrix2d &mean_gradient,
                                Vector &residual, const Tangent tangent)
{
  constexpr int n = 2 * n_shapes;
  IndexSet ghosts = constraints.get_local_lines();
  ghosts.add_indices(discretization.locally_active);
  Vector ghosted(discretization.locally_owned, ghosts, discretization.communicator);
  ghosted  = displacement;
  residual = 0.;
  if (tangent != Tangent::none)
    solver->matrix = 0.;

  Evaluation state;
  FEValues<2> fe_values = discretization.gradients_of_nodes(
    law == Law::linear ? discretization.stiffness_quadrature : discretization.nonlinear_quadrature);
  std::vector<double> values(n);
  FullMatrix<double> element_matrix(n, n);
  dealii::Vector<double> element_residual(n);
  discretization.for_owned_cells(
    [&](const auto &cell, const std::vector<types::global_dof_index> &dofs)
    {
      fe_values.reinit(discretization.on_mesh(cell));
      const LawOfPhase &phase = phases[cell->material_id()];
      ghosted.extract_subvector_to(dofs, values);
      const TriangleSums<n_shapes> sums =
        integrate<n_shapes>(fe_values, phase, values, mean_gradient, tangent, state);
      state.n_inverted += sums.is_inverted;
      state.n_indefinite += sums.is_indefinite;
      state.force_size += sums.f.squaredNorm();
      for (unsigned int i = 0; i < n; ++i)
        element_residual(i) = sums.f(static_cast<Eigen::Index>(i));
      constraints.distribute_local_to_global(element_residual, dofs, residual);
      for (unsigned int i = 0; i < n; i += 2)
        if (const auto held = clamp_of_node.find(dofs[i]); held != clamp_of_node.end())
          state.forces.on_clamps.row(held->second) +=
            sums.f.template segment<2>(static_cast<Eigen::Index>(i)).transpose();
      if (tangent != Tangent::none)
      {
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            element_matrix(i, j) =
              sums.K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        constraints.distribute_local_to_global(element_matrix, dofs, solver->matrix);
      }
    });
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
