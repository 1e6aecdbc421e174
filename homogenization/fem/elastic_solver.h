// SPDX-License-Identifier: MIT
// The linear algebra that cell problems and references share, in deal.II's terms: a distributed
// stiffness matrix, Trilinos' algebraic multigrid with the rigid body modes, a direct solver, and
// conjugate gradients.
#pragma once

#include "homogenization/fem/discretization.h"
#include "meshes/plain/errors.h"

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Eigen/SparseCore>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace homespun::homogenization
{
/// Conjugate gradients met a direction x with x·A x <= 0: A is not positive definite.
class IndefiniteMatrix : public meshes::NotConverged
{
public:
  IndefiniteMatrix(std::vector<double> history, dealii::TrilinosWrappers::MPI::Vector direction)
      : NotConverged("conjugate gradients: the matrix is not positive definite", std::move(history))
      , direction(std::move(direction))
  {
  }

  const dealii::TrilinosWrappers::MPI::Vector direction;
};

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

  /// Factors the present matrix instead: CHOLMOD on one rank, MUMPS on several.
  /// @throws NotConverged where that fails; on one rank where the matrix is not positive definite
  void factorize();

  bool has_preconditioner() const;

  /// Whether a factorization is taken: up to a measured size it is faster than multigrid.
  bool is_small() const;

  /// Where to stop, for the residual r and the preconditioner M.
  struct Target
  {
    double residual; ///< of |r|, in the unit of the right-hand side
    /// Of r . M^-1 r, about twice the energy of the error: where stiff parts lie in soft ones |r|
    /// is that of the stiff parts, and says nothing of the soft ones [J].
    double energy = std::numeric_limits<double>::infinity();
  };

  /// Conjugate gradients from the given start until a residual meets both targets. A start with a
  /// small residual is left as it is: what it misses is round-off.
  /// @return number of iterations
  /// @throws NotConverged with the residual history after `max_iterations`, or where the
  ///   preconditioner turns out not to be positive definite; IndefiniteMatrix where the matrix does
  unsigned int solve(Vector &solution, const Vector &right_hand_side, const Target &target,
                     unsigned int max_iterations);

  struct Solved
  {
    std::vector<unsigned int> iterations; ///< of each right-hand side
    /// Residuals of conjugate gradients that were given up for a direct solver; empty: none were.
    std::vector<double> abandoned;
  };

  /// Several right-hand sides: with a factor of the present matrix all at once, each answer
  /// corrected by the factor until its target is met; else by conjugate gradients. Where these
  /// break down or do not converge, the matrix is factored and the factor takes over.
  /// @param solutions receives the answers
  /// @throws NotConverged with the residual history where the direct solver does not meet a target
  Solved solve_all(std::vector<Vector> &solutions, const std::vector<Vector> &right_hand_sides,
                   const std::vector<Target> &targets, unsigned int max_iterations);

  bool is_direct() const; ///< whether there is a factor
  unsigned int n_ranks() const;

  /// Of the matrix, on one rank.
  Eigen::SparseMatrix<double> lower_triangle() const;

  dealii::TrilinosWrappers::SparseMatrix matrix;

private:
  std::vector<unsigned int> solve_directly(std::vector<Vector> &solutions,
                                           const std::vector<Vector> &right_hand_sides,
                                           const std::vector<Target> &targets) const;

  const Discretization &discretization;
  std::vector<double> rigid_modes;
  struct Preconditioner;
  std::unique_ptr<Preconditioner> preconditioner;
};
} // namespace homespun::homogenization
