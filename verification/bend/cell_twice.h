// SPDX-License-Identifier: MIT
// How far the meshes of a cell and of its sheets move the error of a bent sheet.
#pragma once

#include "verification/bend/bent_sheet.h"

#include <optional>

namespace homespun::verification
{
/// A cell, once as it is drawn and once on its refined mesh.
struct CellTwice
{
  /// @param cell kept by reference
  explicit CellTwice(const homogenization::UnitCell &cell);
  CellTwice(const CellTwice &) = delete; // `finer` refers to its mesh

  const BendingCell drawn;
  const homogenization::UnitCell refined_unit;
  const BendingCell finer;

  /// Of the distance between both meshes, for bars: factor_of_bars() of the strongest corner of the
  /// plate, and no less than what is asked of two meshes whose order is not confirmed.
  const double factor;
};

using OptionalErrors = BentSheet::OfMethods<std::optional<BendingError>>;

/// Mean over the drawn vertices of |delta_1 − delta_2|, delta_k up-sampled less resolved with cell
/// problems, edges and reference on mesh k, on a sheet of n x n cells whose macro curvature has the
/// root mean square 1/m. Nothing of methods that are not known on both.
OptionalErrors distance_of_meshes(const CellTwice &cell, const BendingLoad &load, int n);

/// The same of errors that are known on both meshes.
OptionalErrors distance_of_errors(const meshes::Sheet &drawn,
                                  const BentSheet::OfMethods<BentState> &on_drawn,
                                  const meshes::Sheet &refined,
                                  const BentSheet::OfMethods<BentState> &on_refined);

/// By how much what meshes move of positions grows with the side of a sheet, method by method. Slip
/// and beam of an edge turn the sheet, and what a mesh misses of them moves positions by the
/// sheet's side; but in linear theory terms of edges miss the same on each mesh as the reference.
/// @param ratio side of the sheet over that of the small one, at least 1
BentSheet::OfMethods<double> growth_in_linear_theory(double ratio);
BentSheet::OfMethods<double> growth_at_large_turns(double ratio);

/// Bars from the distances on a small sheet, and in position by a growth.
/// @param factor CellTwice::factor
OptionalErrors carried_bars(const OptionalErrors &distances,
                            const BentSheet::OfMethods<double> &growth, double factor);
} // namespace homespun::verification
