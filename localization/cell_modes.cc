// SPDX-License-Identifier: MIT
#include "localization/cell_modes.h"

#include "localization/coarse_frames.h"

#include <algorithm>

namespace homespun::localization
{
Modes kind_of_modes(const UpsamplerOptions &options)
{
  if (!options.microscopic)
    return linear_modes;
  if (options.fitted != nullptr)
  {
    const auto &kinds = options.edge_kinds;
    return options.edges != nullptr &&
               std::find(kinds.begin(), kinds.end(), EdgeKind::free) != kinds.end()
             ? fitted_modes_and_free_edges
             : fitted_modes;
  }
  return options.second_order.empty() ? linear_modes : quadratic_modes;
}

CellModes cell_modes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options)
{
  if (!options.microscopic)
    return CellModes::Zero(cell.mesh.n_vertices(), 6);
  if (kind_of_modes(options) == linear_modes)
    return anchored(cell, options.anchor);
  CellModes modes(cell.mesh.n_vertices(), 18);
  modes.leftCols(6) = anchored(cell, options.anchor);
  if (are_fitted(kind_of_modes(options)))
    modes.rightCols(12) = anchored_fitted(cell, *options.fitted, options.anchor);
  else
  {
    modes.rightCols(12) = anchored_quadratic(cell, options.second_order, options.anchor);
    modes.middleCols(6, 6) *= 0.5; // of equal strains
  }
  return modes;
}
} // namespace homespun::localization
