// SPDX-License-Identifier: MIT
// A multigrid cycle for several right-hand sides abreast. Trilinos' ML makes the hierarchy
// (smoothed aggregation with the rigid modes), but its cycle passes over every matrix once for each
// right-hand side; this one passes once for up to eight. In double precision: a stiff part that
// moves as a whole loses its contrast times the rounding of its matrix.
#pragma once

#include <mpi.h>

#include <memory>

class Epetra_CrsMatrix;
class Epetra_MultiVector;
class Epetra_Operator;

namespace homespun::homogenization
{
/// x = M r: one pass over the finest mesh, two over each that is half as fine (W-cycle), with
/// Chebyshev's polynomials of D^-1 A before and after, D the diagonal; symmetric and positive
/// definite. The coarsest problem is factored on every rank.
/// Source: P. Vanek, J. Mandel, M. Brezina, Computing 56, 1996; M. Adams, M. Brezina, J. Hu, R.
/// Tuminaro, J. Comput. Phys. 188, 2003 (the polynomials).
class MultigridCycle
{
public:
  /// @param finest symmetric, positive definite; must stay as it is
  /// @param hierarchy ML_Epetra::MultiLevelPreconditioner of it; not needed afterwards
  /// @param degree of the polynomials
  /// @throws NotConverged where the coarsest matrix is not positive definite
  MultigridCycle(const Epetra_CrsMatrix &finest, const Epetra_Operator &hierarchy,
                 unsigned int degree, MPI_Comm communicator);
  ~MultigridCycle();

  /// M r for each column. All ranks must call this.
  void apply(const Epetra_MultiVector &residuals, Epetra_MultiVector &preconditioned);

private:
  class Levels;
  std::unique_ptr<Levels> levels;
};
} // namespace homespun::homogenization
