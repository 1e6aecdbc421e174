// SPDX-License-Identifier: MIT
// The linear algebra that cell problems and references share: a distributed stiffness matrix,
// Trilinos' algebraic multigrid with the rigid body modes (in space: the translations) or, on one
// rank, a Cholesky factorization, and conjugate gradients.
#pragma once

#include "homogenization/fem/conjugate_gradients.h"
#include "homogenization/fem/discretization.h"

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace homespun::homogenization
{
/// Elasticity with the preconditioner kept between solves, because nearby matrices (the steps of
/// Newton's method) can share one.
class ElasticSolver
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /// Lays out the matrix for the given constraints (whose masters may live on another rank).
  ElasticSolver(const Discretization &discretization,
                const dealii::AffineConstraints<double> &constraints);
  ~ElasticSolver();

  /// A vector of the DoFs that this rank owns, zero.
  Vector owned_vector() const;

  /// Builds the multigrid hierarchy from the present matrix.
  void build_preconditioner();

  /// Factors the present matrix in the place of a multigrid hierarchy: then solve_abreast() has a
  /// few iterations, which refine the answer to round-off. On one rank alone.
  /// @throws NotConverged where the matrix is not positive definite
  void factorize();

  bool has_preconditioner() const;

  /// Whether a Cholesky factorization is faster than multigrid: on one rank, up to a measured size.
  bool is_small() const;

  /// Conjugate gradients from the given start until the residual r = b − A x has |r| <= tolerance
  /// and, with the preconditioner M, r . M^-1 r <= energy_tolerance. The latter is about twice the
  /// energy of the error: where stiff parts lie in soft ones the former is that of the stiff parts,
  /// and says nothing of the soft ones. A start that meets the first is left as it is: what it
  /// misses is round-off.
  /// @param tolerance absolute, in the unit of the right-hand side
  /// @param energy_tolerance absolute [J]
  /// @return number of iterations
  /// @throws NotConverged with the residual history after `max_iterations`, or where the
  ///   preconditioner turns out not to be positive definite; IndefiniteMatrix where the matrix does
  unsigned int solve(Vector &solution, const Vector &right_hand_side, double tolerance,
                     unsigned int max_iterations = 2000,
                     double energy_tolerance     = std::numeric_limits<double>::infinity());

  using Target = GradientsTarget; ///< where conjugate gradients stop, see solve()

  /// solve() for several right-hand sides abreast: conjugate gradients of each by itself, whose
  /// iterations pass over the matrix, and over multigrid's (MultigridCycle), once for all of them;
  /// with multigrid for six at a time, because vectors of more take as much memory as the matrix.
  /// One that has met its target is left as it is.
  /// @param solutions the starts, and the answers
  /// @param right_hand_sides become the residuals: hand over what is not needed afterwards
  /// @return number of iterations of each
  /// @throws as solve()
  std::vector<unsigned int> solve_abreast(std::vector<Vector> &solutions,
                                          std::vector<Vector> right_hand_sides,
                                          const std::vector<Target> &targets,
                                          unsigned int max_iterations);

  /// What is stored of a row of the matrix that this rank owns.
  struct MatrixRow
  {
    double *values     = nullptr; ///< (n), which an assembly may add to
    const int *columns = nullptr; ///< (n) local numbers, see local_column()
    int n              = 0;
  };

  /// @param row counted from the first that this rank owns
  MatrixRow matrix_row(int row) const;

  /// The number that a DoF has among the columns of this rank's rows.
  int local_column(int dof) const;

  dealii::TrilinosWrappers::SparseMatrix matrix;

private:
  const Discretization &discretization;
  std::vector<double> rigid_modes;
  struct Preconditioner;
  std::unique_ptr<Preconditioner> preconditioner;
};
} // namespace homespun::homogenization
