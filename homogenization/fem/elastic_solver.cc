// SPDX-License-Identifier: MIT
#include "homogenization/fem/elastic_solver.h"

#include "homogenization/algebra/cholesky_factor.h"
#include "homogenization/fem/multigrid_cycle.h"
#include "homogenization/fem/rigid_modes.h"
#include "meshes/plain/errors.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace homespun::homogenization
{
using namespace dealii;

namespace
{
/// Up to which a Cholesky factorization on one rank is faster than multigrid. Measured on square
/// inclusions of contrast 10, with OpenBLAS, on a machine with other work: of P1 with 33,282,
/// 132,098 and 526,338 DoFs it takes 0.21, 0.5 and 0.7 of the time, of P2 with 526,338 half; of
/// three-stiffness with 739,458, nothing beside, 0.77 with P1 and 0.55 with P2, and 1.7 times the
/// memory of multigrid. Of a sheet of P2 with 1.15 million it is no faster. The factor grows as
/// n log n, in memory, and its work as n^3/2.
constexpr unsigned long most_dofs_of_direct_solver = 800000;
} // namespace

/// One of the three.
struct ElasticSolver::Preconditioner
{
  TrilinosWrappers::PreconditionAMG multigrid;
  std::unique_ptr<MultigridCycle> cycle; ///< of loads abreast
  std::unique_ptr<CholeskyFactor> factor;

  void apply(const Epetra_MultiVector &residual, Epetra_MultiVector &preconditioned)
  {
    if (cycle)
      return cycle->apply(residual, preconditioned);
    if (!factor)
    {
      multigrid.trilinos_operator().ApplyInverse(residual, preconditioned);
      return;
    }
    Eigen::MatrixXd columns(residual.MyLength(), residual.NumVectors());
    for (int k = 0; k < residual.NumVectors(); ++k)
      columns.col(k) = Eigen::Map<const Eigen::VectorXd>(residual[k], columns.rows());
    columns = factor->solve(columns);
    for (int k = 0; k < residual.NumVectors(); ++k)
      Eigen::Map<Eigen::VectorXd>(preconditioned[k], columns.rows()) = columns.col(k);
  }
};

ElasticSolver::ElasticSolver(const Discretization &discretization,
                             const AffineConstraints<double> &constraints)
    : discretization(discretization)
{
  const IndexSet rows = constraints.get_local_lines();
  const auto n_dofs   = discretization.locally_owned.size();
  DynamicSparsityPattern pattern(n_dofs, n_dofs, rows);
  discretization.for_owned_triangles(
    [&](unsigned int, const std::vector<types::global_dof_index> &dofs)
    { constraints.add_entries_local_to_global(dofs, pattern, false); });
  SparsityTools::distribute_sparsity_pattern(pattern, discretization.locally_owned,
                                             discretization.communicator, rows);
  matrix.reinit(discretization.locally_owned, discretization.locally_owned, pattern,
                discretization.communicator);
  rigid_modes = rigid_body_modes(discretization);
}

ElasticSolver::~ElasticSolver() = default;

bool ElasticSolver::has_preconditioner() const
{
  return preconditioner != nullptr;
}

bool ElasticSolver::is_small() const
{
  return Utilities::MPI::n_mpi_processes(discretization.communicator) == 1 &&
         discretization.n_dofs() <= most_dofs_of_direct_solver;
}

ElasticSolver::Vector ElasticSolver::owned_vector() const
{
  return Vector(discretization.locally_owned, discretization.communicator);
}

void ElasticSolver::build_preconditioner()
{
  // Measured on cells of 47,000 to 740,000 DoFs: with the constant modes alone and a V-cycle the
  // iterations grow from 40 to 57; with the rotation as a third mode and a W-cycle they stay at 32.
  TrilinosWrappers::PreconditionAMG::AdditionalData options;
  options.elliptic              = true;
  options.higher_order_elements = discretization.order > 1;
  options.smoother_sweeps       = discretization.order > 1 ? 3 : 2;
  options.aggregation_threshold = 0.;
  options.w_cycle               = true;

  Teuchos::ParameterList parameters;
  std::unique_ptr<Epetra_MultiVector> unused_modes;
  options.set_parameters(parameters, unused_modes, matrix);
  parameters.set("null space: type", "pre-computed");
  parameters.set("null space: dimension", 3);
  parameters.set("null space: vectors", rigid_modes.data());
  if (discretization.n_components == 2)
    parameters.set("PDE equations", 2);
  if (discretization.n_components == 3)
  {
    // Measured on a hanging sheet of 434,283 DoFs, whose plane is 1e4 times as stiff as its normal:
    // nodes aggregated with all components and the translations as modes take less than half the
    // time of components aggregated apart; with the rotation as a fourth mode the steps fail. The
    // smoother has to reach down to the soft normal, hence the wide range of eigenvalues. A W-cycle
    // saves a quarter of the iterations and costs half as much again.
    parameters.set("PDE equations", 3);
    parameters.set("smoother: Chebyshev alpha", 20.);
    parameters.set("prec type", "MGV");
  }
  preconditioner = std::make_unique<Preconditioner>();
  preconditioner->multigrid.initialize(matrix, parameters);
}


void ElasticSolver::factorize()
{
  const Epetra_CrsMatrix &stored = matrix.trilinos_matrix();
  const int n                    = stored.NumMyRows();
  AssertThrow(n == stored.NumGlobalRows() && stored.ColMap().SameAs(stored.RowMap()),
              ExcMessage("a factorization is made on one rank"));
  int *first = nullptr, *columns = nullptr;
  double *values = nullptr;
  stored.ExtractCrsDataPointers(first, columns, values);
  // The matrix is symmetric: its rows are its columns, and nothing has to be transposed.
  const Eigen::Map<const Eigen::SparseMatrix<double>> all(n, n, first[n], first, columns, values);
  preconditioner         = std::make_unique<Preconditioner>();
  preconditioner->factor = std::make_unique<CholeskyFactor>(
    Eigen::SparseMatrix<double>(all.triangularView<Eigen::Lower>()), "cell problems");
}

unsigned int ElasticSolver::solve(Vector &solution, const Vector &right_hand_side,
                                  const double tolerance, const unsigned int max_iterations,
                                  const double energy_tolerance)
{
  // Written out, because deal.II's SolverCG neither notices a direction of negative curvature nor
  // hands out its residual history.
  Vector residual(right_hand_side), image(right_hand_side);
  matrix.vmult(image, solution);
  residual -= image;
  std::vector<double> history = {residual.l2_norm()};
  if (history.back() <= tolerance)
    return 0;

  const bool is_by_residual = std::isinf(energy_tolerance);
  Vector preconditioned(residual), direction(residual);
  double product = 0.;
  for (unsigned int iteration = 1; iteration <= max_iterations; ++iteration)
  {
    preconditioner->apply(residual.trilinos_vector(), preconditioned.trilinos_vector());
    const double old_product = product;
    product                  = residual * preconditioned;
    if (history.back() <= tolerance && std::abs(product) <= energy_tolerance)
      return iteration - 1;
    if (!(product > 0.) || !std::isfinite(product))
      throw meshes::NotConverged("conjugate gradients: the preconditioner is not positive definite",
                                 history);
    if (iteration == 1)
      direction = preconditioned;
    else
      direction.sadd(product / old_product, preconditioned);
    matrix.vmult(image, direction);
    const double curvature = direction * image;
    if (!(curvature > 0.) || !std::isfinite(curvature))
      throw IndefiniteMatrix(history, direction);
    const double step = product / curvature;
    solution.add(step, direction);
    residual.add(-step, image);
    history.push_back(residual.l2_norm());
    if (is_by_residual && history.back() <= tolerance)
      return iteration;
  }
  throw not_converged({tolerance, energy_tolerance}, product, history);
}

std::vector<unsigned int> ElasticSolver::solve_abreast(std::vector<Vector> &solutions,
                                                       std::vector<Vector> right_hand_sides,
                                                       const std::vector<Target> &targets,
                                                       const unsigned int max_iterations)
{
  const auto apply = [this](const Epetra_MultiVector &from, Epetra_MultiVector &to)
  { preconditioner->apply(from, to); };
  const std::size_t at_once = preconditioner->factor ? targets.size() : 6;
  if (!preconditioner->factor && !preconditioner->cycle)
  {
    preconditioner->cycle = std::make_unique<MultigridCycle>(
      matrix.trilinos_matrix(), preconditioner->multigrid.trilinos_operator(),
      discretization.order > 1 ? 3 : 2, discretization.communicator);
    preconditioner->multigrid.clear(); // from here on solve() takes the cycle, too
  }
  std::vector<unsigned int> iterations;
  for (std::size_t first = 0; first < targets.size(); first += at_once)
  {
    std::vector<LoadAbreast> loads;
    for (std::size_t k = first; k < std::min(first + at_once, targets.size()); ++k)
      loads.push_back({&solutions[k], &right_hand_sides[k], targets[k]});
    const std::vector<unsigned int> its =
      gradients_abreast(matrix.trilinos_matrix(), apply, loads, max_iterations);
    iterations.insert(iterations.end(), its.begin(), its.end());
  }
  return iterations;
}

ElasticSolver::MatrixRow ElasticSolver::matrix_row(const int row) const
{
  MatrixRow stored;
  int *columns = nullptr;
  matrix.trilinos_matrix().ExtractMyRowView(row, stored.n, stored.values, columns);
  stored.columns = columns;
  return stored;
}

int ElasticSolver::local_column(const int dof) const
{
  return matrix.trilinos_matrix().LCID(dof);
}
} // namespace homespun::homogenization
