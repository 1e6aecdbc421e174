// SPDX-License-Identifier: MIT
// Cells that are hard on multigrid: orthotropic ground, stiff parts, a hole; on any number of
// ranks.
#include "homogenization/fem/elastic_solver.h"
#include "homogenization/fem/periodic_constraints.h"
#include "meshes/plain/errors.h"
#include "tests/homogenization/cell/cells.h"
#include "tests/homogenization/cell/shipped.h"

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

#include <vector>

using namespace homespun;
using namespace homespun::homogenization;
using tests::relative_difference;

namespace
{
/// Of n x n x 2 triangles; with 4608 unknowns and more multigrid has two levels. A stiff angle that
/// is interrupted, on ground that is `ratio` times as stiff along one axis.
UnitCell quilt(const int n, const double ratio, const double contrast)
{
  const std::vector<Phase> phases = {{"ground", ratio, 1., 0.3, 0.4, 20., 1., 1.},
                                     isotropic("seam", contrast, 0.3, 1., 1.)};
  return tests::cell_of(tests::skewed_lattice(), n, n, phases,
                        [](const double f1, const double f2) {
                          return (f1 > 0.2 && f1 < 0.4 && f2 < 0.7) || (f2 > 0.5 && f2 < 0.6) ? 1
                                                                                              : 0;
                        });
}
} // namespace

// Both solvers find the same stiffness, to what the stop of conjugate gradients leaves, whose
// square counts, and to what sums of forces of this contrast lose.
TEST(ranks_hard_cells, multigrid_and_direct_solver_agree)
{
  for (const unsigned int order : {1u, 2u})
    for (const double ratio : {3., 100.})
      for (const double contrast : {150., 1e6})
      {
        const UnitCell cell = quilt(48 / static_cast<int>(order), ratio, contrast);
        HomogenizationOptions options;
        options.order                  = order;
        options.solver                 = CellSolver::direct;
        const Homogenization direct    = homogenize(cell, options, MPI_COMM_WORLD);
        options.solver                 = CellSolver::multigrid;
        const Homogenization multigrid = homogenize(cell, options, MPI_COMM_WORLD);
        EXPECT_EQ(direct.solver, CellSolver::direct);
        EXPECT_TRUE(direct.abandoned.empty());
        EXPECT_TRUE(multigrid.abandoned.empty()) << "P" << order << " " << ratio << " " << contrast;
        EXPECT_EQ(multigrid.solver, CellSolver::multigrid);
        EXPECT_LT(relative_difference(direct.stiffness, multigrid.stiffness), 1e-10)
          << "P" << order << " " << ratio << " " << contrast;
        // One rank is a reference to several.
        options.solver             = CellSolver::direct;
        const Homogenization alone = homogenize(cell, options, MPI_COMM_SELF);
        EXPECT_LT(relative_difference(direct.stiffness, alone.stiffness), 1e-10);
      }
}

// A smoother that is told of too small a largest eigenvalue is not positive: here with P2, whose
// eigenvalues a few iterations estimate worse than those of P1.
TEST(ranks_hard_cells, multigrid_stays_positive_on_curved_inclusions)
{
  HomogenizationOptions options;
  options.order  = 2;
  options.refine = 3;
  options.solver = CellSolver::multigrid;
  const Homogenization result =
    homogenize(tests::shipped("three-stiffness"), options, MPI_COMM_WORLD);
  EXPECT_TRUE(result.abandoned.empty());
}

// Where conjugate gradients cannot meet their target within the iterations that they are given, the
// direct solver takes over, and what was tried is told.
TEST(ranks_hard_cells, the_direct_solver_takes_over_from_conjugate_gradients)
{
  const UnitCell cell = quilt(48, 3., 150.);
  const Discretization discretization(cell.mesh, 1, MPI_COMM_WORLD);
  dealii::AffineConstraints<double> constraints;
  make_periodic_constraints(discretization, cell.lattice, Eigen::RowVector2d::Zero(),
                            discretization.boundary_nodes(), constraints);
  ElasticSolver solver(discretization, constraints);
  auto fe_values       = discretization.fe_values(discretization.stiffness_quadrature);
  const unsigned int n = fe_values.dofs_per_cell;
  dealii::FullMatrix<double> matrix(n, n);
  dealii::Vector<double> load(n);
  ElasticSolver::Vector loads = solver.owned_vector();
  discretization.for_owned_cells(
    [&](const auto &element, const std::vector<dealii::types::global_dof_index> &dofs)
    {
      fe_values.reinit(element);
      const dealii::FEValuesExtractors::Vector displacement(0);
      const double stiffness = element->material_id() == 1 ? 150. : 1.;
      for (unsigned int i = 0; i < n; ++i)
      {
        const auto strain = fe_values[displacement].symmetric_gradient(i, 0);
        load(i)           = stiffness * strain[0][0] * fe_values.JxW(0);
        for (unsigned int j = 0; j < n; ++j)
          matrix(i, j) = stiffness * fe_values.JxW(0) *
                         (strain * fe_values[displacement].symmetric_gradient(j, 0));
      }
      constraints.distribute_local_to_global(matrix, load, dofs, solver.matrix, loads);
    });
  solver.matrix.compress(dealii::VectorOperation::add);
  loads.compress(dealii::VectorOperation::add);
  solver.build_preconditioner();
  std::vector<ElasticSolver::Vector> answers(1, solver.owned_vector());
  const ElasticSolver::Target target{1e-10 * loads.l2_norm()};
  const ElasticSolver::Solved solved = solver.solve_all(answers, {loads}, {target}, 3);
  EXPECT_TRUE(solver.is_direct());
  EXPECT_EQ(solved.abandoned.size(), 4u); // the start and three iterations
  ElasticSolver::Vector residual(loads);
  EXPECT_LE(solver.matrix.residual(residual, answers[0], loads), target.residual);
  // A target that no arithmetic reaches is not claimed to be met.
  EXPECT_THROW(solver.solve_all(answers, {loads}, {{1e-30 * loads.l2_norm()}}, 3),
               meshes::NotConverged);
}
