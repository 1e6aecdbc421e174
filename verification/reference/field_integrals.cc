// SPDX-License-Identifier: MIT
#include "verification/reference/field_integrals.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

namespace homespun::verification
{
using namespace dealii;
using homogenization::AffineTriangle;
using homogenization::Discretization;
using Vector = homogenization::ElasticSolver::Vector;

namespace
{
/// A triangle that this rank owns, at one quadrature point.
struct Sample
{
  std::size_t q;
  double weight; ///< with the determinant [m^2]
  Eigen::RowVector2d point;
  const AffineTriangle &triangle;
  const std::vector<types::global_dof_index> &dofs;
};

template <typename Function>
void for_each_sample(const Discretization &discretization, const Quadrature<2> &quadrature,
                     const Function &function)
{
  discretization.for_owned_triangles(
    [&](const unsigned int t, const std::vector<types::global_dof_index> &dofs)
    {
      const AffineTriangle triangle(discretization.mesh, t);
      const auto corner = [&](const int k) -> Eigen::RowVector2d
      { return discretization.mesh.vertices.row(discretization.mesh.triangles(t, k)); };
      for (std::size_t q = 0; q < quadrature.size(); ++q)
      {
        const Point<2> &at = quadrature.point(static_cast<unsigned int>(q));
        function(Sample{q, quadrature.weight(static_cast<unsigned int>(q)) * triangle.determinant,
                        (1. - at[0] - at[1]) * corner(0) + at[0] * corner(1) + at[1] * corner(2),
                        triangle, dofs});
      }
    });
}
} // namespace

Vector load_vector(const Discretization &discretization,
                   const AffineConstraints<double> &constraints,
                   const std::function<FieldValue(const Eigen::RowVector2d &)> &force)
{
  const QWitherdenVincentSimplex<2> quadrature(3);
  const FiniteElement<2> &shapes = discretization.shapes;
  const unsigned int n           = discretization.n_components;
  Vector load(discretization.locally_owned, discretization.communicator);
  dealii::Vector<double> of_element(discretization.n_dofs_per_triangle);
  for_each_sample(discretization, quadrature,
                  [&](const Sample &sample)
                  {
                    const FieldValue f = sample.weight * force(sample.point);
                    const Point<2> &at = quadrature.point(static_cast<unsigned int>(sample.q));
                    for (unsigned int i = 0; i < shapes.n_dofs_per_cell(); ++i)
                      for (unsigned int c = 0; c < n; ++c)
                        of_element(n * i + c) = f(c) * shapes.shape_value(i, at);
                    constraints.distribute_local_to_global(of_element, sample.dofs, load);
                  });
  load.compress(VectorOperation::add);
  return load;
}

FieldDistance distance(const Discretization &discretization, const Vector &field,
                       const KnownField &known, const bool modulo_translation)
{
  const QWitherdenVincentSimplex<2> quadrature(4);
  const FiniteElement<2> &shapes = discretization.shapes;
  const unsigned int n           = discretization.n_components;
  const unsigned int n_shapes    = shapes.n_dofs_per_cell();
  Vector ghosted(discretization.locally_owned, discretization.locally_relevant,
                 discretization.communicator);
  ghosted = field;

  // Squares of the difference and of its gradient, its integral, the area.
  std::vector<double> sums(6, 0.);
  for_each_sample(
    discretization, quadrature,
    [&](const Sample &sample)
    {
      const Point<2> &at     = quadrature.point(static_cast<unsigned int>(sample.q));
      FieldValue difference  = -known.value(sample.point);
      FieldGradient gradient = -known.gradient(sample.point);
      for (unsigned int i = 0; i < n_shapes; ++i)
      {
        const Tensor<1, 2> g = shapes.shape_grad(i, at);
        const Eigen::RowVector2d slope =
          (sample.triangle.inverse_transpose * Eigen::Vector2d(g[0], g[1])).transpose();
        for (unsigned int c = 0; c < n; ++c)
        {
          const double value = ghosted(sample.dofs[n * i + c]);
          difference(c) += value * shapes.shape_value(i, at);
          gradient.row(c) += value * slope;
        }
      }
      for (unsigned int c = 0; c < n; ++c)
      {
        sums[0] += sample.weight * difference(c) * difference(c);
        sums[1] += sample.weight * gradient.row(c).squaredNorm();
        sums[2 + c] += sample.weight * difference(c);
      }
      sums[5] += sample.weight;
    });
  const std::vector<double> of_this_rank = sums;
  Utilities::MPI::sum(of_this_rank, discretization.communicator, sums);
  double square = sums[0];
  if (modulo_translation)
    square -= (sums[2] * sums[2] + sums[3] * sums[3] + sums[4] * sums[4]) / sums[5];
  return {std::sqrt(std::max(0., square)), std::sqrt(sums[1])};
}
} // namespace homespun::verification
