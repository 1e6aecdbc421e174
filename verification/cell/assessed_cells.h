// SPDX-License-Identifier: MIT
// The cells of a run of several studies: each is homogenized once, however many of them ask, and
// what an earlier process of the same run left in cell.h5 and homogenize.json is taken up.
#pragma once

#include "verification/cell/assessed_cell.h"

#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What a study asks of a cell beside C^H and chi.
struct CellNeeds
{
  std::vector<meshes::Law> second_order; ///< whose quadratic modes and cubic energy
  bool edges   = false;                  ///< slip, tension and modes of its edges
  bool bending = false;                  ///< D^H and deflections
};

/// Cells by P1 on their given mesh, the discretization of the fine reference, so that a study shows
/// the error of the method and not of two meshes; C^H is bracketed there on the first rank, D^H by
/// P2. All ranks call the functions alike.
class AssessedCells
{
public:
  /// A cell; what is known of it is not made again.
  /// @param verdicts its checks are added, named after the cell; those of brackets on the first
  ///   rank alone
  /// @throws BadInput, NotConverged
  const AssessedCell &of(const homogenization::UnitCell &cell, const CellNeeds &needs,
                         MPI_Comm communicator, std::vector<Verdict> &verdicts);

  /// Takes up what write_cell_results() of the same revision left of a cell, where it is there
  /// whole: all that of() gives but the bracket itself, of which the checks remain.
  /// @return whether it was
  /// @throws BadInput where it is damaged
  bool read(const homogenization::UnitCell &cell, const std::string &folder, MPI_Comm communicator);

  /// Takes over the D^H of the same cell that is there already.
  void take_bending(const homogenization::UnitCell &cell, const CellBending &bending);

private:
  std::map<std::string, AssessedCell> cells;   ///< by name and fingerprint()
  std::map<std::string, CellBending> bendings; ///< the same, on the first rank
};
} // namespace homespun::verification
