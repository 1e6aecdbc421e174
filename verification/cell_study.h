// SPDX-License-Identifier: MIT
// What `homespun homogenize` does with one cell.
#pragma once

#include "verification/cell_output.h"

#include <mpi.h>

#include <string>

namespace homespun::verification
{
struct CellStudyOptions
{
  homogenization::HomogenizationOptions solve;
  BracketOptions bracket; ///< its order and refinement are those of `solve`
  std::string output;
  bool quiet = false;
};

/// Homogenizes a cell on all ranks, brackets C^H on the first one (direct solvers: the answer knows nothing of
/// the number of ranks), and writes what write_cell_results() writes.
/// @return checks on every rank; of other ranks than the first without those of the bracket, but with a failed
///   one where the first rank has one
/// @throws BadInput, NotConverged
AssessedCell run_cell_study(const homogenization::UnitCell &cell, const CellStudyOptions &options,
                            MPI_Comm communicator);
} // namespace homespun::verification
