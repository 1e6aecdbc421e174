// SPDX-License-Identifier: MIT
// What `homespun homogenize` does.
#pragma once

#include "verification/cell/assessed_cell.h"
#include "verification/cell/sensitivity.h"
#include "verification/record/earlier.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
struct CellStudyOptions
{
  homogenization::HomogenizationOptions solve; ///< its pieces are in `output`
  BracketOptions bracket;                      ///< its order and refinement are those of `solve`
  std::vector<UncertainInput> uncertain;       ///< inputs that are known to a range alone
  bool bars   = true;  ///< false: the cell problems alone, with neither bracket nor a finer solve
  bool pieces = false; ///< characteristic-displacements-refined.pvtu, a piece from each rank
  std::string output;
  Earlier earlier = Earlier::keep_work;
  bool quiet      = false;
};

/// Homogenizes a cell on all ranks, brackets C^H and D^H on the first one (direct solvers: the
/// answer knows nothing of the number of ranks), and writes what write_cell_results() writes. The
/// folder is one run.
/// @return checks on every rank; of other ranks than the first without those of the bracket, but
///   with a failed one where the first rank has one
/// @throws BadInput, NotConverged
AssessedCell run_cell_study(const homogenization::UnitCell &cell, const CellStudyOptions &options,
                            MPI_Comm communicator);

struct HomogenizeOptions
{
  std::string file, uncertain; ///< the cell, and what of it is known to a range alone
  CellStudyOptions study;
};

/// Homogenizes a cell and prints its summary, on all ranks.
/// @return the exit status of its checks
/// @throws BadInput where cell or options are not sound, NotConverged
int homogenize_cell(const HomogenizeOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
