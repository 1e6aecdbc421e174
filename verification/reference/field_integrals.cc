// SPDX-License-Identifier: MIT
#include "verification/reference/field_integrals.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

namespace homespun::verification
{
using namespace dealii;
using homogenization::Discretization;
using Vector = homogenization::ElasticSolver::Vector;

namespace
{
Eigen::RowVector2d rest_point(const FEValues<2> &fe_values, const unsigned int q)
{
  const Point<2> &point = fe_values.quadrature_point(q);
  return {point[0], point[1]};
}
} // namespace

Vector load_vector(const Discretization &discretization,
                   const AffineConstraints<double> &constraints,
                   const std::function<FieldValue(const Eigen::RowVector2d &)> &force)
{
  FEValues<2> fe_values = discretization.fe_values(
    QWitherdenVincentSimplex<2>(3), update_values | update_quadrature_points | update_JxW_values);
  Vector load(discretization.locally_owned, discretization.communicator);
  dealii::Vector<double> of_cell(fe_values.dofs_per_cell);
  discretization.for_owned_cells(
    [&](const auto &cell, const std::vector<types::global_dof_index> &dofs)
    {
      fe_values.reinit(cell);
      of_cell = 0.;
      for (const unsigned int q : fe_values.quadrature_point_indices())
      {
        const FieldValue f = fe_values.JxW(q) * force(rest_point(fe_values, q));
        for (const unsigned int i : fe_values.dof_indices())
          of_cell(i) += f(i % discretization.n_components) * fe_values.shape_value(i, q);
      }
      constraints.distribute_local_to_global(of_cell, dofs, load);
    });
  load.compress(VectorOperation::add);
  return load;
}

FieldDistance distance(const Discretization &discretization, const Vector &field,
                       const KnownField &known, const bool modulo_translation)
{
  FEValues<2> fe_values = discretization.fe_values(QWitherdenVincentSimplex<2>(4),
                                                   update_values | update_gradients |
                                                     update_quadrature_points | update_JxW_values);
  Vector ghosted(discretization.locally_owned, discretization.locally_active,
                 discretization.communicator);
  ghosted = field;

  // Squares of the difference and of its gradient, its integral, the area.
  std::vector<double> sums(6, 0.);
  discretization.for_owned_cells(
    [&](const auto &cell, const std::vector<types::global_dof_index> &dofs)
    {
      fe_values.reinit(cell);
      for (const unsigned int q : fe_values.quadrature_point_indices())
      {
        const double weight    = fe_values.JxW(q);
        FieldValue difference  = -known.value(rest_point(fe_values, q));
        FieldGradient gradient = -known.gradient(rest_point(fe_values, q));
        for (const unsigned int i : fe_values.dof_indices())
        {
          const double value        = ghosted(dofs[i]);
          const unsigned int c      = i % discretization.n_components;
          const Tensor<1, 2> &slope = fe_values.shape_grad(i, q);
          difference(c) += value * fe_values.shape_value(i, q);
          gradient.row(c) += value * Eigen::RowVector2d(slope[0], slope[1]);
        }
        for (unsigned int c = 0; c < discretization.n_components; ++c)
        {
          sums[0] += weight * difference(c) * difference(c);
          sums[1] += weight * gradient.row(c).squaredNorm();
          sums[2 + c] += weight * difference(c);
        }
        sums[5] += weight;
      }
    });
  const std::vector<double> of_this_rank = sums;
  Utilities::MPI::sum(of_this_rank, discretization.communicator, sums);
  double square = sums[0];
  if (modulo_translation)
    square -= (sums[2] * sums[2] + sums[3] * sums[3] + sums[4] * sums[4]) / sums[5];
  return {std::sqrt(std::max(0., square)), std::sqrt(sums[1])};
}
} // namespace homespun::verification
