// SPDX-License-Identifier: MIT
// The Bloch margin along a load of one mesh, and where it is lost first.
#pragma once

#include "verification/bloch/bloch_margin.h"
#include "verification/bloch/stability_tables.h"
#include "verification/bloch/strain_path.h"

#include <string>
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
  std::vector<StabilityRow> rows; ///< without cell, law, load and mesh
  LossRow loss;                   ///< likewise, and without its bar
  MarginLevel shown;              ///< just beyond the loss, or else the last one that was reached
  std::string why;                ///< no further state was found; empty where all were
};

/// The levels of a path, and the strain of first loss between two of them: by bisection on the line
/// through both margins, to 1e-4.
/// @param strains of one sign, ascending in size
MarginPath margin_path(const CellAssembly &assembly, const BlochMargin &bloch, const Load &load,
                       const std::vector<double> &strains);

/// The zone at a level: a row per wave, without cell, law, load and way.
std::vector<ZoneRow> zone_of(const CellAssembly &assembly, const BlochMargin &bloch,
                             const MarginLevel &level);

/// The field of a level, likewise. Empty where none was found.
std::vector<ModeRow> mode_of(const CellAssembly &assembly, const MarginLevel &level);
} // namespace homespun::verification
