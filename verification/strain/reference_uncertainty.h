// SPDX-License-Identifier: MIT
// The error bar of the fine reference: how far P1 on the given mesh is from P2 on the refined one,
// at the same vertices, and how that carries over to the full sheet and to every strain.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/cell/discretization_distance.h"
#include "verification/reference/laws.h"
#include "verification/reference/loads.h"
#include "verification/strain/strain_tables.h"

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The error bar of the P1 reference of one cell and load.
///
/// Measured on a small sheet with P1, P2 and refined P2: the linear law, which all laws approach at
/// small strain, and each nonlinear law at `large_strain`. In between, and beyond, the bar per
/// strain runs linearly in strain, never below half of the smaller of the two. A law that is not
/// reached at `large_strain` keeps its small-strain bar; a bar that cannot be measured at all is
/// not a number, and empty in the results. To carry over to the full
/// sheet it is multiplied by the ratio of |P1 − P2|, linear law, at full size and on the small
/// sheet, both measured. Of periodic loads the cell itself is measured and nothing carries over.
class ReferenceUncertainty
{
public:
  static constexpr double small_strain = 1e-3, large_strain = 0.05;

  /// @param n_cells of the full sheet per side
  /// @param n_small of the small sheet per side
  /// @param table receives what was measured, and gives back what it holds already; on the first
  ///   rank, elsewhere null
  ReferenceUncertainty(const homogenization::UnitCell &cell, const Load &load,
                       const std::vector<Law> &laws, int n_cells, int n_small,
                       Table<UncertaintyRow> *table, MPI_Comm communicator,
                       const std::function<void(const std::string &)> &tell);

  /// Mean over the vertices of the sheet [m].
  double at(Law law, double strain) const;

private:
  DiscretizationDistance measure(int n, Law law, double strain, bool with_refined);

  const homogenization::UnitCell &cell;
  const Load load;
  const MPI_Comm communicator;
  double carry_over = 1.;
  double side       = 0.; ///< sqrt(|Y|) [m]
  double order      = 1.; ///< order_of_p2()
  double linear_bar = 0.; ///< per strain and side
  std::vector<std::pair<Law, double>> large_bars;
};
} // namespace homespun::verification
