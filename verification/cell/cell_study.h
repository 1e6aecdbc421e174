// SPDX-License-Identifier: MIT
// What `homespun homogenize` does with one cell, and what other studies do with theirs.
#pragma once

#include "verification/cell/assessed_cell.h"
#include "verification/cell/sensitivity.h"
#include "verification/record/run_folder.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
struct CellStudyOptions
{
  homogenization::HomogenizationOptions solve; ///< its checkpoint and pieces are in `output`
  BracketOptions bracket;                      ///< its order and refinement are those of `solve`
  std::vector<UncertainInput> uncertain;       ///< inputs that are known to a range alone
  bool bars   = true;  ///< false: the cell problems alone, with neither bracket nor a finer solve
  bool pieces = false; ///< characteristic-displacements-refined.pvtu, a piece from each rank
  std::string output;
  Earlier earlier = Earlier::keep_work; ///< the loads that the same run had solved are taken up
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

/// Homogenizes a cell with P1 on its given mesh, the discretization of the fine reference, so that
/// a study shows the error of the method and not of two meshes; brackets C^H there on the first
/// rank.
/// @param verdicts the checks are added to them, named after the cell; those of the bracket on the
///   first rank alone
/// @param second_order laws whose quadratic modes and cubic energy the study asks for
/// @throws BadInput, NotConverged
AssessedCell assess_for_study(const homogenization::UnitCell &cell, MPI_Comm communicator,
                              std::vector<Verdict> &verdicts,
                              const std::vector<homogenization::MembraneLaw> &second_order = {});

/// Brackets D^H on the first rank, by P2 on the given mesh, and hands its deflections on to all
/// ranks.
/// @param verdicts the checks are added to them on the first rank, named after the cell
void add_bending_for_study(const homogenization::UnitCell &cell, MPI_Comm communicator,
                           AssessedCell &assessed, std::vector<Verdict> &verdicts);
} // namespace homespun::verification
