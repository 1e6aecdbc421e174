// SPDX-License-Identifier: MIT
#include "homogenization/fem/elastic_solver.h"

#include "meshes/plain/errors.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <cmath>
#include <sstream>

namespace homespun::homogenization
{
using namespace dealii;

namespace
{
/// The translations and, in the plane, the rotation about the centre, mode after mode, on the owned
/// DoFs. The rotation is scaled by the size of the mesh so that the modes do not depend on the unit
/// of length.
std::vector<double> rigid_body_modes(const Discretization &discretization)
{
  const IndexSet &owned            = discretization.locally_owned;
  const std::size_t n              = owned.n_elements();
  const meshes::TriangleMesh &mesh = discretization.mesh;
  const Eigen::RowVector2d lowest  = mesh.vertices.colwise().minCoeff();
  const Eigen::RowVector2d highest = mesh.vertices.colwise().maxCoeff();
  const Eigen::RowVector2d centre  = 0.5 * (lowest + highest);
  const double size                = (highest - lowest).maxCoeff();

  std::vector<double> modes(3 * n, 0.);
  for (const Node &node : discretization.owned_nodes())
  {
    const Eigen::RowVector2d arm = (node.point - centre) / size;
    const std::size_t first      = owned.index_within_set(node.first_dof);
    for (unsigned int c = 0; c < discretization.n_components; ++c)
      modes[c * n + first + c] = 1.;
    if (discretization.n_components == 2)
    {
      modes[2 * n + first]     = -arm(1);
      modes[2 * n + first + 1] = arm(0);
    }
  }
  return modes;
}
} // namespace

ElasticSolver::ElasticSolver(const Discretization &discretization,
                             const AffineConstraints<double> &constraints)
    : discretization(discretization)
{
  const IndexSet rows = constraints.get_local_lines();
  DynamicSparsityPattern pattern(discretization.dof_handler.n_dofs(),
                                 discretization.dof_handler.n_dofs(), rows);
  DoFTools::make_sparsity_pattern(discretization.dof_handler, pattern, constraints, false);
  SparsityTools::distribute_sparsity_pattern(pattern, discretization.locally_owned,
                                             discretization.communicator, rows);
  matrix.reinit(discretization.locally_owned, discretization.locally_owned, pattern,
                discretization.communicator);
  rigid_modes = rigid_body_modes(discretization);
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
  preconditioner = std::make_unique<TrilinosWrappers::PreconditionAMG>();
  preconditioner->initialize(matrix, parameters);
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
    preconditioner->vmult(preconditioned, residual);
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
  std::ostringstream text;
  text << "conjugate gradients did not reach a residual of " << tolerance;
  if (!is_by_residual)
    text << " and an energy of the error of " << 0.5 * energy_tolerance << " J";
  text << " in " << max_iterations << " iterations; the last are " << history.back();
  if (!is_by_residual)
    text << " and " << 0.5 * product << " J";
  throw meshes::NotConverged(text.str(), history);
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
