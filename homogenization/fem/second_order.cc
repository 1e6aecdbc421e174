// SPDX-License-Identifier: MIT
#include "homogenization/fem/second_order.h"

#include "meshes/plain/homogenized_cell.h"

#include <deal.II/base/mpi.h>

#include <cmath>

namespace homespun::homogenization
{
using namespace dealii;
using Vector = ElasticSolver::Vector;

namespace
{
constexpr int most_unknowns = 12; ///< of a triangle: P2, two components
/// Entries 11, 12, 21, 22 of the gradients of a triangle's unknowns.
using GradientMatrix = Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, most_unknowns>;
using Unknowns       = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, most_unknowns, 3>;
using ElementLoads   = Eigen::Matrix<double, Eigen::Dynamic, 6, 0, most_unknowns, 6>;

GradientMatrix gradient_matrix(const FEValues<2> &fe_values, const unsigned int q)
{
  GradientMatrix matrix = GradientMatrix::Zero(4, fe_values.dofs_per_cell);
  for (const unsigned int i : fe_values.dof_indices())
    for (unsigned int d = 0; d < 2; ++d)
      matrix(2 * (i % 2) + d, i) = fe_values.shape_grad(i, q)[d];
  return matrix;
}

/// H11, H12, H21, H22 of the three unit macro strains, which turn nothing.
Eigen::Matrix<double, 4, 3> unit_gradients()
{
  Eigen::Matrix<double, 4, 3> columns;
  columns << 1., 0., 0., 0., 0., 0.5, 0., 0., 0.5, 0., 1., 0.;
  return columns;
}

/// The right-hand sides of the modes, and what comes with them.
struct QuadraticLoads
{
  std::vector<Vector> loads;   ///< in the order of meshes::strain_pairs [N]
  std::array<double, 6> sizes; ///< of the element loads before they cancel [N]
  meshes::CubicForm energy;    ///< W3 [N/m]
};

QuadraticLoads quadratic_loads(const SolvedCell &solved, const Law law, const Vector &zero)
{
  const Discretization &discretization    = solved.discretization;
  std::vector<Eigen::Matrix3d> stiffness  = solved.cell.stiffness_of_phase();
  const QuadraticStrain q                 = quadratic_strain(law);
  const Eigen::Matrix<double, 4, 3> macro = unit_gradients();

  QuadraticLoads result;
  result.loads.assign(meshes::strain_pairs.size(), zero);
  result.sizes.fill(0.);
  FEValues<2> fe_values = discretization.fe_values(discretization.nonlinear_quadrature);
  const auto n          = static_cast<Eigen::Index>(fe_values.dofs_per_cell);
  dealii::Vector<double> load(fe_values.dofs_per_cell);
  discretization.for_owned_cells(
    [&](const auto &element, const std::vector<types::global_dof_index> &dofs)
    {
      fe_values.reinit(element);
      const std::size_t phase = element->material_id();
      Unknowns chi(n, 3);
      for (int a = 0; a < 3; ++a)
        for (Eigen::Index i = 0; i < n; ++i)
          chi(i, a) = solved.chi[static_cast<std::size_t>(a)](dofs[static_cast<std::size_t>(i)]);
      ElementLoads element_loads = ElementLoads::Zero(n, 6);
      for (const unsigned int q_point : fe_values.quadrature_point_indices())
      {
        const GradientMatrix G              = gradient_matrix(fe_values, q_point);
        const Eigen::Matrix<double, 4, 3> H = macro - G * chi;
        const double weight                 = fe_values.JxW(q_point);
        std::array<GradientEntries, 6> stresses;
        for (std::size_t k = 0; k < stresses.size(); ++k)
        {
          const auto [a, b] = meshes::strain_pairs[k];
          stresses[k]       = weight * second_order_stress(stiffness[phase], q, H.col(a), H.col(b));
          element_loads.col(static_cast<Eigen::Index>(k)) += G.transpose() * stresses[k];
        }
        for (std::size_t m = 0; m < meshes::CubicForm::indices.size(); ++m)
        {
          const auto [a, b, c] = meshes::CubicForm::indices[m];
          for (std::size_t k = 0; k < stresses.size(); ++k)
            if (meshes::strain_pairs[k][0] == a && meshes::strain_pairs[k][1] == b)
              result.energy.derivatives(static_cast<Eigen::Index>(m)) += stresses[k].dot(H.col(c));
        }
      }
      for (std::size_t k = 0; k < result.loads.size(); ++k)
      {
        const auto column = element_loads.col(static_cast<Eigen::Index>(k));
        for (Eigen::Index i = 0; i < n; ++i)
          load(static_cast<unsigned int>(i)) = column(i);
        solved.constraints.distribute_local_to_global(load, dofs, result.loads[k]);
        result.sizes[k] += column.squaredNorm();
      }
    });
  for (std::size_t k = 0; k < result.loads.size(); ++k)
  {
    result.loads[k].compress(VectorOperation::add);
    result.sizes[k] = std::sqrt(Utilities::MPI::sum(result.sizes[k], discretization.communicator));
  }
  MPI_Allreduce(MPI_IN_PLACE, result.energy.derivatives.data(), 10, MPI_DOUBLE, MPI_SUM,
                discretization.communicator);
  result.energy.derivatives /= solved.cell.lattice.area();
  return result;
}
} // namespace

SecondOrderFields second_order_fields(const SolvedCell &solved, const Law law,
                                      const SecondOrderTarget &target, ElasticSolver &solver)
{
  const QuadraticLoads right = quadratic_loads(solved, law, solver.owned_vector());
  std::vector<Vector> modes(right.loads.size(), solver.owned_vector());
  std::vector<ElasticSolver::Target> targets;
  for (std::size_t k = 0; k < modes.size(); ++k)
  {
    const auto [a, b]   = meshes::strain_pairs[k];
    const double energy = std::sqrt(target.energies(a) * target.energies(b));
    targets.push_back(
      {target.tolerance * right.sizes[k], std::pow(1e2 * target.tolerance, 2) * energy});
  }
  const ElasticSolver::Solved found =
    solver.solve_all(modes, right.loads, targets, target.most_iterations);
  for (Vector &mode : modes)
    solved.constraints.distribute(mode);
  return {modes, right.energy, found.abandoned};
}
} // namespace homespun::homogenization
