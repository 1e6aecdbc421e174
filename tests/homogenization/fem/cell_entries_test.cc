// SPDX-License-Identifier: MIT
// What loops over the cells find once is held against what deal.II says of each cell.
#include "homogenization/fem/cell_entries.h"
#include "homogenization/fem/node_gradients.h"
#include "tests/meshes/plain/shapes.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::homogenization;
using dealii::types::global_dof_index;

TEST(exact_node_gradients, are_those_of_deal_ii)
{
  const meshes::TriangleMesh mesh = tests::parallelogram(tests::skewed_lattice(), 4, 3);
  for (const unsigned int order : {1u, 2u})
  {
    const Discretization discretization(mesh, order, MPI_COMM_SELF);
    auto fe_values = discretization.fe_values(discretization.nonlinear_quadrature);
    NodeGradients gradients(discretization, discretization.nonlinear_quadrature);
    ASSERT_EQ(gradients.n_points(), static_cast<int>(fe_values.n_quadrature_points));
    discretization.for_owned_cells(
      [&](const auto &cell, const std::vector<global_dof_index> &)
      {
        fe_values.reinit(cell);
        gradients.reinit(static_cast<int>(cell->active_cell_index()));
        EXPECT_NEAR(gradients.area(), cell->measure(), 1e-15);
        for (const unsigned int q : fe_values.quadrature_point_indices())
        {
          const auto point = static_cast<int>(q);
          EXPECT_NEAR(gradients.weight(point), fe_values.JxW(q), 1e-15);
          const auto compare = [&](const auto &slopes)
          {
            for (int k = 0; k < slopes.rows(); ++k)
              for (int axis = 0; axis < 2; ++axis)
                EXPECT_NEAR(slopes(k, axis),
                            fe_values.shape_grad(2 * static_cast<unsigned int>(k),
                                                 q)[static_cast<unsigned int>(axis)],
                            1e-12 * slopes.cwiseAbs().maxCoeff());
          };
          if (order == 1)
            compare(gradients.at<3>(point));
          else
            compare(gradients.at<6>(point));
        }
      });
  }
}

namespace
{
/// A sheet of which one side is held.
template <int order, int n_components>
struct HeldSheet
{
  static constexpr int n_nodes = 3 * order, n = n_nodes * n_components;
  using Stiffness = Eigen::Matrix<double, n, n, Eigen::RowMajor>;
  using AtNodes   = Eigen::Matrix<double, n_nodes, n_components, Eigen::RowMajor>;

  const Discretization discretization{tests::parallelogram(tests::skewed_lattice(), 16, 12), order,
                                      MPI_COMM_WORLD, n_components};
  dealii::AffineConstraints<double> constraints;
  std::unique_ptr<ElasticSolver> solver;

  HeldSheet()
  {
    constraints.reinit(discretization.locally_active);
    for (const Node &node : discretization.boundary_nodes())
      if (std::abs(node.point(1)) < 1e-9 &&
          discretization.locally_active.is_element(node.first_dof))
        for (unsigned int c = 0; c < n_components; ++c)
          constraints.add_line(node.first_dof + c);
    constraints.close();
    solver = std::make_unique<ElasticSolver>(discretization, constraints);
  }

  /// Sums of something, no two entries of which are alike, as deal.II adds them up.
  /// @param forces receives a sum, too
  /// @return the matrix's rows, values of each after another
  std::vector<double> by_deal_ii(ElasticSolver::Vector &forces)
  {
    solver->matrix = 0.;
    discretization.for_owned_cells(
      [&](const auto &cell, const std::vector<global_dof_index> &dofs)
      {
        const Stiffness K = stiffness(static_cast<int>(cell->active_cell_index()));
        constraints.distribute_local_to_global(dealii::FullMatrix<double>(n, n, K.data()), dofs,
                                               solver->matrix);
        const AtNodes f = K.row(0).template reshaped<Eigen::RowMajor>(n_nodes, n_components);
        constraints.distribute_local_to_global(dealii::Vector<double>(f.data(), f.data() + n), dofs,
                                               forces);
      });
    return values(forces);
  }

  std::vector<double> by_entries(ElasticSolver::Vector &forces)
  {
    solver->matrix = 0.;
    const CellEntries cells(discretization, constraints, *solver);
    int n_plain = 0;
    for (int cell = 0; cell < cells.n_cells(); ++cell)
    {
      const Stiffness K = stiffness(cells.triangle(cell));
      cells.template add<n_nodes, n_components>(K, cell);
      const AtNodes f = K.row(0).template reshaped<Eigen::RowMajor>(n_nodes, n_components);
      cells.add(f, cell, forces);
      n_plain += cells.is_plain(cell);
    }
    EXPECT_GT(4 * n_plain, cells.n_cells()); // else nothing is shown
    return values(forces);
  }

  static Stiffness stiffness(const int triangle)
  {
    Stiffness K;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        K(i, j) = std::sin(1. + triangle + 17. * i + 0.3 * j);
    return K;
  }

  std::vector<double> values(ElasticSolver::Vector &forces)
  {
    solver->matrix.compress(dealii::VectorOperation::add);
    forces.compress(dealii::VectorOperation::add);
    int *first = nullptr, *columns = nullptr;
    double *begin = nullptr;
    solver->matrix.trilinos_matrix().ExtractCrsDataPointers(first, columns, begin);
    return {begin, begin + solver->matrix.trilinos_matrix().NumMyNonzeros()};
  }
};

template <int order, int n_components>
void sums_are_equal()
{
  HeldSheet<order, n_components> sheet;
  ElasticSolver::Vector forces = sheet.solver->owned_vector(), others = forces;
  const std::vector<double> of_matrix = sheet.by_deal_ii(forces), by = sheet.by_entries(others);
  ASSERT_EQ(of_matrix.size(), by.size());
  // Where several ranks add to an entry, they may do so in another order.
  const double tolerance = sheet.solver->n_ranks() == 1 ? 0. : 1e-14;
  for (std::size_t k = 0; k < by.size(); ++k)
    ASSERT_NEAR(of_matrix[k], by[k], tolerance) << k;
  others -= forces;
  EXPECT_LE(others.linfty_norm(), tolerance);
}
} // namespace

TEST(ranks_cell_entries, sums_are_those_of_deal_ii)
{
  sums_are_equal<1, 2>();
  sums_are_equal<2, 2>();
  sums_are_equal<1, 3>();
  sums_are_equal<2, 3>();
}

TEST(ranks_cell_entries, values_are_those_of_the_cells_nodes)
{
  HeldSheet<2, 3> sheet;
  ElasticSolver::Vector field = sheet.solver->owned_vector();
  for (const auto dof : sheet.discretization.locally_owned)
    field(dof) = static_cast<double>(dof);
  field.compress(dealii::VectorOperation::insert);
  const CellEntries cells(sheet.discretization, sheet.constraints, *sheet.solver);
  const ElasticSolver::Vector everywhere = cells.with_ghosts(field);
  int cell                               = 0;
  sheet.discretization.for_owned_cells(
    [&](const auto &of, const std::vector<global_dof_index> &dofs)
    {
      EXPECT_EQ(cells.triangle(cell), static_cast<int>(of->active_cell_index()));
      const auto found = cells.values<6, 3>(everywhere, cell++);
      for (int i = 0; i < 18; ++i)
        EXPECT_EQ(found(i / 3, i % 3), static_cast<double>(dofs[static_cast<std::size_t>(i)]));
    });
}
