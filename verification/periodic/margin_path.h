// SPDX-License-Identifier: MIT
// The Bloch margin along a load of one mesh, where it is lost first, by which waves, and what the
// cloth becomes beyond.
#pragma once

#include "verification/periodic/bloch_margin.h"
#include "verification/periodic/load_control.h"
#include "verification/periodic/periodic_tables.h"

#include <optional>
#include <vector>

namespace homespun::verification
{
/// A periodic state with its margin.
struct MarginLevel
{
  double strain = 0.;
  CellEquilibrium state;
  Margin margin;
};

/// What was found along a path that is pulled or pressed.
struct MarginPath
{
  std::vector<MarginLevel> levels; ///< that were reached
  std::vector<StabilityRow> rows;  ///< of these, and of the one that was not
  StabilityRow loss;               ///< without its bar
  MarginLevel shown;               ///< just beyond the loss, or else the last one that was reached
};

/// A row of a kind, named as its path.
StabilityRow row_of(const StabilityRow &path, const std::string &kind, int number, double strain);

/// The levels of a path, and the strain of first loss between two of them: by bisection on the line
/// through both margins, to 1e-4.
/// @param control of one unit of strain
/// @param strains of one sign, ascending in size
/// @param names of the path
MarginPath margin_path(const BlochMargin &bloch, const LoadControl &control,
                       const std::vector<double> &strains, const StabilityRow &names);

/// The zone at a level: a row per wave.
std::vector<StabilityRow> waves_of(const BlochMargin &bloch, const MarginLevel &level,
                                   const StabilityRow &names);

/// The field of a level, a row per vertex. Empty where none was found.
std::vector<StabilityRow> mode_of(const meshes::TriangleMesh &mesh, const MarginLevel &level,
                                  const StabilityRow &names);

/// Follows the lowest wave at each level that is lost; nowhere of a cell whose sides meet holes,
/// which makes no supercell.
/// @param cells that are solved as one; nothing: those over which the lowest wave of a level
///   repeats, where that is finite
std::vector<StabilityRow> patterns_of(const BlochMargin &bloch, const LoadControl &control,
                                      const std::vector<MarginLevel> &levels,
                                      const std::optional<Eigen::Vector2i> &cells,
                                      const StabilityRow &names);
} // namespace homespun::verification
