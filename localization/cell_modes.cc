// SPDX-License-Identifier: MIT
#include "localization/cell_modes.h"

#include "localization/coarse_frames.h"

namespace homespun::localization
{
Modes kind_of_modes(const UpsamplerOptions &options)
{
  return !options.microscopic            ? linear_modes
         : options.fitted != nullptr     ? fitted_modes
         : !options.second_order.empty() ? quadratic_modes
                                         : linear_modes;
}

CellModes cell_modes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options)
{
  if (!options.microscopic)
    return CellModes::Zero(cell.mesh.n_vertices(), 6);
  if (kind_of_modes(options) == linear_modes)
    return anchored(cell, options.anchor);
  CellModes modes(cell.mesh.n_vertices(), 18);
  modes.leftCols(6) = anchored(cell, options.anchor);
  if (kind_of_modes(options) == fitted_modes)
    modes.rightCols(12) = anchored_fitted(cell, *options.fitted, options.anchor);
  else
  {
    modes.rightCols(12) = anchored_quadratic(cell, options.second_order, options.anchor);
    modes.middleCols(6, 6) *= 0.5; // of equal strains
  }
  return modes;
}
} // namespace homespun::localization
