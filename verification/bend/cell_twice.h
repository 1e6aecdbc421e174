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
  explicit CellTwice(const homogenization::UnitCell &cell);

  const BendingCell drawn;
  const homogenization::UnitCell refined_unit;
  const BendingCell finer;
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

/// Bars from the distances on a small sheet: three times, because two meshes confirm no order
/// (Roache 1994), and in position by the ratio of the sheets' sides: what a mesh misses of slip and
/// beam of an edge turns the sheet, whose position moves by its side.
/// @param ratio side of the sheet over that of the small one, at least 1
OptionalErrors carried_bars(const OptionalErrors &distances, double ratio);
} // namespace homespun::verification
