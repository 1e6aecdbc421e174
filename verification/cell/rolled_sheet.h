// SPDX-License-Identifier: MIT
// From which radius on D^H holds, as the program finds it and says it.
#pragma once

#include "homogenization/bracket/rolled_cell.h"
#include "verification/cell/cell_bracket.h"
#include "verification/record/json_files.h"

#include <optional>
#include <string>

namespace homespun::verification
{
/// A cell rolled up, on its mesh, or why it is not known.
struct KnownRoll
{
  std::optional<homogenization::RolledCell> rolled;
  std::string why_not;
};

/// On this process alone.
KnownRoll roll_of(const homogenization::UnitCell &cell, const BracketOptions &options);

/// By how much a sheet may be stiffer than D^H says: from the radius on that this leaves, D^H
/// holds.
constexpr double tolerated_stiffening = 0.02;

/// From which radius on D^H holds, in the worst direction and along x and y, with a warning on a
/// second line where cloth folds more tightly than that; or why that is not known.
std::string roll_text(const KnownRoll &known);

/// The same, and for each direction from x.
nlohmann::ordered_json json_rolled(const KnownRoll &known);
} // namespace homespun::verification
