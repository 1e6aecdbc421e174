// SPDX-License-Identifier: MIT
#include "homogenization/fem/elastic_solver.h"

#include "homogenization/algebra/cholesky_factor.h"
#include "homogenization/fem/rigid_modes.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>

#include <Teuchos_ParameterList.hpp>

#include <cmath>
#include <sstream>
#include <string>

namespace homespun::homogenization
{
using namespace dealii;

namespace
{
using Vector = ElasticSolver::Vector;

/// Up to which a factorization is taken. Of three-stiffness with P2, three loads, direct solver
/// over multigrid in seconds: 739,458 DoFs 0.34 on one rank (CHOLMOD), 0.6 on two (MUMPS);
/// 2,953,474 DoFs 0.73 and 1.29, with 1.9 and 3.6 times the memory. In between the two meet on two
/// ranks near 1.9 million, and a factor takes 2.5 kB per DoF. It grows as n log n, its work as
/// n^3/2.
constexpr unsigned long most_dofs_of_direct_solver = 1600000;
constexpr unsigned int most_corrections            = 10; ///< of a direct solver

using Target = ElasticSolver::Target;

meshes::NotConverged not_converged(const std::string &solver, const Target &target,
                                   const double product, const std::vector<double> &history)
{
  std::ostringstream text;
  text << solver << " did not reach a residual of " << target.residual;
  if (!std::isinf(target.energy))
    text << " and an energy of the error of " << 0.5 * target.energy << " J";
  text << " in " << history.size() - 1 << " iterations; the last are " << history.back();
  if (!std::isinf(target.energy))
    text << " and " << 0.5 * product << " J";
  return {text.str(), history};
}

/// A matrix that refuses directions of negative curvature, which SolverCG passes over.
struct PositiveMatrix
{
  void vmult(Vector &image, const Vector &direction) const
  {
    matrix.vmult(image, direction);
    const double curvature = direction * image;
    if (!(curvature > 0.) || !std::isfinite(curvature))
      throw IndefiniteMatrix(control.get_history_data(), direction);
  }

  const TrilinosWrappers::SparseMatrix &matrix;
  const SolverControl &control;
};

/// Thrown out of SolverCG, whose iterate is then good enough: only where the preconditioner has
/// been applied to a residual is its energy known.
struct EnergyIsMet
{
};

/// A preconditioner M that refuses to be indefinite, and stops where r . M^-1 r meets the target.
template <typename Preconditioner>
struct PositivePreconditioner
{
  void vmult(Vector &corrections, const Vector &residuals) const
  {
    preconditioner.vmult(corrections, residuals);
    product = residuals * corrections;
    if (!(product > 0.) || !std::isfinite(product))
      throw meshes::NotConverged("conjugate gradients: the preconditioner is not positive definite",
                                 control.get_history_data());
    if (control.get_history_data().back() <= target.residual && product <= target.energy)
      throw EnergyIsMet();
  }

  const Preconditioner &preconditioner;
  const SolverControl &control;
  const Target &target;
  double &product;
};
} // namespace

/// One of the three.
struct ElasticSolver::Preconditioner
{
  std::unique_ptr<TrilinosWrappers::PreconditionAMG> multigrid;
  std::unique_ptr<CholeskyFactor> factor;             ///< on one rank
  std::unique_ptr<TrilinosWrappers::SolverDirect> lu; ///< on several

  void vmult(Vector &corrections, const Vector &residuals) const
  {
    const auto n = static_cast<Eigen::Index>(residuals.size());
    if (factor)
      Eigen::Map<Eigen::VectorXd>(corrections.begin(), n) =
        factor->solve(Eigen::Map<const Eigen::VectorXd>(residuals.begin(), n));
    else if (lu)
      lu->solve(corrections, residuals);
    else
      multigrid->vmult(corrections, residuals);
  }

  /// Of several; a factor is read once.
  void vmult(std::vector<Vector> &corrections, const std::vector<Vector> &residuals) const
  {
    if (!factor)
    {
      for (std::size_t k = 0; k < residuals.size(); ++k)
        vmult(corrections[k], residuals[k]);
      return;
    }
    const auto n = static_cast<Eigen::Index>(residuals.front().size());
    Eigen::MatrixXd columns(n, residuals.size());
    for (std::size_t k = 0; k < residuals.size(); ++k)
      columns.col(static_cast<Eigen::Index>(k)) =
        Eigen::Map<const Eigen::VectorXd>(residuals[k].begin(), n);
    columns = factor->solve(columns);
    for (std::size_t k = 0; k < residuals.size(); ++k)
      Eigen::Map<Eigen::VectorXd>(corrections[k].begin(), n) =
        columns.col(static_cast<Eigen::Index>(k));
  }
};

ElasticSolver::ElasticSolver(const Discretization &discretization,
                             const AffineConstraints<double> &constraints)
    : discretization(discretization)
{
  const IndexSet rows = constraints.get_local_lines();
  const auto n_dofs   = discretization.n_dofs();
  DynamicSparsityPattern pattern(n_dofs, n_dofs, rows);
  DoFTools::make_sparsity_pattern(discretization.dof_handler, pattern, constraints, false,
                                  discretization.triangulation.locally_owned_subdomain());
  SparsityTools::distribute_sparsity_pattern(pattern, discretization.locally_owned,
                                             discretization.communicator, rows);
  matrix.reinit(discretization.locally_owned, discretization.locally_owned, pattern,
                discretization.communicator);
}

ElasticSolver::~ElasticSolver() = default;

bool ElasticSolver::has_preconditioner() const
{
  return preconditioner != nullptr;
}

bool ElasticSolver::is_small() const
{
  return discretization.n_dofs() <= most_dofs_of_direct_solver;
}

Vector ElasticSolver::owned_vector() const
{
  return Vector(discretization.locally_owned, discretization.communicator);
}

void ElasticSolver::build_preconditioner()
{
  // What PreconditionAMG::AdditionalData makes of elliptic problems, but for the modes, of which it
  // takes none that turn. Measured on cells of 47,000 to 740,000 DoFs: with the constant modes
  // alone and a V-cycle the iterations grow from 40 to 57; with the rotation as a third mode and a
  // W-cycle they stay at 32. On three-stiffness with P2 and 185,410 DoFs two sweeps and
  // prolongations damped by 1.6 take 5.1 s for three loads in 39 iterations; three sweeps and ML's
  // 4/3 take 8.0 s in 38.
  const bool is_in_space = discretization.n_components == 3;
  if (rigid_modes.empty())
    rigid_modes = rigid_body_modes(discretization);
  Teuchos::ParameterList parameters;
  parameters.set("default values", "SA");
  parameters.set("ML output", 0);
  parameters.set("max levels", 10);
  parameters.set("aggregation: type", discretization.order > 1 ? "Uncoupled" : "Uncoupled-MIS");
  parameters.set("aggregation: threshold", 0.);
  parameters.set("smoother: type", "Chebyshev");
  parameters.set("smoother: sweeps", is_in_space && discretization.order > 1 ? 3 : 2);
  // Chebyshev's polynomial is not positive beyond the largest eigenvalue it is told of: ten
  // iterations, ML's default, fall short of it there by more than it allows for.
  parameters.set("eigen-analysis: iterations", 30);
  parameters.set("coarse: type", "Amesos-KLU");
  parameters.set("coarse: max size", 2000);
  parameters.set("initialize random seed", true); // the same hierarchy every time
  parameters.set("PDE equations", static_cast<int>(discretization.n_components));
  parameters.set("null space: type", "pre-computed");
  parameters.set("null space: dimension", 3);
  parameters.set("null space: vectors", rigid_modes.data());
  // Measured on a hanging sheet of 434,283 DoFs, whose plane is 1e4 times as stiff as its normal:
  // nodes aggregated with all components and the translations as modes take less than half the time
  // of components aggregated apart; with the rotation as a fourth mode the steps fail. The smoother
  // has to reach down to the soft normal, hence the wide range of eigenvalues. A W-cycle saves a
  // quarter of the iterations and costs half as much again.
  parameters.set("smoother: Chebyshev alpha", is_in_space ? 20. : 10.);
  parameters.set("prec type", is_in_space ? "MGV" : "MGW");
  if (!is_in_space)
    parameters.set("aggregation: damping factor", 1.6);
  preconditioner            = std::make_unique<Preconditioner>();
  preconditioner->multigrid = std::make_unique<TrilinosWrappers::PreconditionAMG>();
  preconditioner->multigrid->initialize(matrix, parameters);
}

Eigen::SparseMatrix<double> ElasticSolver::lower_triangle() const
{
  // Not by deal.II's iterators, each of which makes room for a full row: n^2 in all.
  const int n  = static_cast<int>(matrix.m());
  int *columns = nullptr, *first = nullptr;
  double *values = nullptr;
  matrix.trilinos_matrix().ExtractCrsDataPointers(first, columns, values);
  // The matrix is symmetric: its rows are its columns, and nothing has to be transposed.
  const Eigen::Map<const Eigen::SparseMatrix<double>> all(n, n, first[n], first, columns, values);
  return all.triangularView<Eigen::Lower>();
}

void ElasticSolver::factorize()
{
  auto made = std::exchange(preconditioner, nullptr);
  if (made && made->factor) // whose order and room serve again
  {
    made->factor->factorize(lower_triangle());
    preconditioner = std::move(made);
    return;
  }
  made.reset(); // what takes memory goes first
  made = std::make_unique<Preconditioner>();
  if (n_ranks() == 1)
    made->factor = std::make_unique<CholeskyFactor>(lower_triangle(), "cell problems");
  else
    try
    {
      static SolverControl unused;
      made->lu = std::make_unique<TrilinosWrappers::SolverDirect>(
        unused, TrilinosWrappers::SolverDirect::AdditionalData(false, "Amesos_Mumps"));
      made->lu->initialize(matrix);
    }
    catch (const ExceptionBase &fault)
    {
      throw meshes::NotConverged(std::string("the direct solver (MUMPS) stopped: ") + fault.what(),
                                 {});
    }
  preconditioner = std::move(made);
}

unsigned int ElasticSolver::solve(Vector &solution, const Vector &right_hand_side,
                                  const Target &target, const unsigned int max_iterations)
{
  SolverControl control(max_iterations, target.residual, false, false);
  control.enable_history_data();
  double product = 0.;
  const PositivePreconditioner<Preconditioner> positive_preconditioner{*preconditioner, control,
                                                                       target, product};
  SolverCG<Vector> conjugate_gradients(control);
  conjugate_gradients.connect(
    [&](const unsigned int iteration, const double residual, const Vector &)
    {
      const bool is_final = iteration == 0 || residual == 0. || std::isinf(target.energy);
      if (residual <= target.residual && is_final)
        return SolverControl::success;
      return iteration < max_iterations ? SolverControl::iterate : SolverControl::failure;
    });
  try
  {
    conjugate_gradients.solve(PositiveMatrix{matrix, control}, solution, right_hand_side,
                              positive_preconditioner);
  }
  catch (const EnergyIsMet &)
  {
  }
  catch (const SolverControl::NoConvergence &)
  {
    throw not_converged("conjugate gradients", target, product, control.get_history_data());
  }
  return static_cast<unsigned int>(control.get_history_data().size()) - 1;
}

ElasticSolver::Solved ElasticSolver::solve_all(std::vector<Vector> &solutions,
                                               const std::vector<Vector> &right_hand_sides,
                                               const std::vector<Target> &targets,
                                               const unsigned int max_iterations)
{
  Solved solved;
  if (!is_direct())
    try
    {
      for (std::size_t k = 0; k < targets.size(); ++k)
        solved.iterations.push_back(
          solve(solutions[k], right_hand_sides[k], targets[k], max_iterations));
      return solved;
    }
    catch (const meshes::NotConverged &failure)
    {
      solved.abandoned = failure.residual_history();
      factorize();
    }
  solved.iterations = solve_directly(solutions, right_hand_sides, targets);
  return solved;
}

unsigned int ElasticSolver::n_ranks() const
{
  return Utilities::MPI::n_mpi_processes(discretization.communicator);
}

bool ElasticSolver::is_direct() const
{
  return preconditioner && (preconditioner->factor || preconditioner->lu);
}

std::vector<unsigned int> ElasticSolver::solve_directly(std::vector<Vector> &solutions,
                                                        const std::vector<Vector> &right_hand_sides,
                                                        const std::vector<Target> &targets) const
{
  std::vector<Vector> residuals = right_hand_sides, corrections(targets.size(), owned_vector());
  std::vector<std::vector<double>> histories(targets.size());
  std::vector<unsigned int> iterations(targets.size(), 0);
  std::vector<double> products(targets.size(), std::numeric_limits<double>::infinity());
  for (Vector &solution : solutions)
    solution = 0.;
  // A row of n entries is summed with an error of n eps |A| |x|: no residual is known better. A
  // target below the last digit of the load is none.
  const double stiffness = matrix.linfty_norm();
  const double per_row   = static_cast<double>(matrix.n_nonzero_elements()) /
                         static_cast<double>(matrix.m()) * std::numeric_limits<double>::epsilon();
  const auto is_round_off = [&](const std::size_t k)
  {
    const std::vector<double> &sizes = histories[k];
    return sizes.size() > 1 && sizes.back() > 0.5 * sizes[sizes.size() - 2] &&
           targets[k].residual >=
             std::numeric_limits<double>::epsilon() * right_hand_sides[k].l2_norm() &&
           sizes.back() <=
             per_row * (stiffness * solutions[k].l2_norm() + right_hand_sides[k].l2_norm());
  };
  for (unsigned int iteration = 0;; ++iteration)
  {
    preconditioner->vmult(corrections, residuals);
    bool are_met = true;
    for (std::size_t k = 0; k < targets.size(); ++k)
    {
      const double product = residuals[k] * corrections[k], size = residuals[k].l2_norm();
      histories[k].push_back(size);
      // A correction that gains no digit is the round-off of the residual: there is no better
      // answer.
      const bool is_final = iteration == 0 || std::abs(product) <= targets[k].energy ||
                            std::abs(product) > 0.1 * products[k];
      products[k] = std::abs(product);
      if ((size <= targets[k].residual && is_final) || is_round_off(k))
        continue;
      are_met = false;
      if (iteration == most_corrections || !std::isfinite(product))
        throw not_converged("the direct solver", targets[k], product, histories[k]);
      solutions[k] += corrections[k];
      ++iterations[k];
      matrix.residual(residuals[k], solutions[k], right_hand_sides[k]);
    }
    if (are_met)
      return iterations;
  }
}
} // namespace homespun::homogenization
