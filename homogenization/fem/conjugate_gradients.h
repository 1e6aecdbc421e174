// SPDX-License-Identifier: MIT
// Conjugate gradients of several right-hand sides with one matrix, of which those that are solved
// drop out; where they stop, and what they meet where a matrix is not positive definite.
#pragma once

#include "meshes/plain/errors.h"

#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

class Epetra_CrsMatrix;
class Epetra_MultiVector;

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

struct GradientsTarget
{
  double residual;                                         ///< in the unit of the right-hand side
  double energy = std::numeric_limits<double>::infinity(); ///< [J]
};

/// One of several systems with the same matrix.
struct LoadAbreast
{
  dealii::TrilinosWrappers::MPI::Vector *solution; ///< the start, and the answer
  dealii::TrilinosWrappers::MPI::Vector *residual; ///< begins as the right-hand side
  GradientsTarget target;
};

/// @param preconditioner puts M^-1 of its first argument, a column for each load, into the second
/// @return number of iterations of each
/// @throws as ElasticSolver::solve()
std::vector<unsigned int> gradients_abreast(
  const Epetra_CrsMatrix &A,
  const std::function<void(const Epetra_MultiVector &, Epetra_MultiVector &)> &preconditioner,
  const std::vector<LoadAbreast> &loads, unsigned int max_iterations);

/// That conjugate gradients have not met their target.
/// @param energy r . M^-1 r of the last iteration
meshes::NotConverged not_converged(const GradientsTarget &target, double energy,
                                   const std::vector<double> &history);
} // namespace homespun::homogenization
