// SPDX-License-Identifier: MIT
// From which radius on D^H holds, as the program says it, without deal.II: `homespun check` warns
// of it at once.
#pragma once

#include "homogenization/bracket/rolled_cell.h"
#include "homogenization/cell/finding.h"
#include "homogenization/cell/unit_cell.h"
#include "verification/record/json_files.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A cell rolled up, on its mesh, or why it is not known.
struct KnownRoll
{
  std::optional<homogenization::RolledCell> rolled;
  std::string why_not;
};

/// By how much a sheet may be stiffer than D^H says: from the radius on that this leaves, D^H
/// holds.
constexpr double tolerated_stiffening = 0.02;

/// Cloth folds to this radius, and more tightly [m].
constexpr double radius_of_folds = 0.05;

/// From which radius on D^H holds, in the worst direction and along x and y; on a second line how
/// stiff the sheet is in the limit of small radii; and with a warning on a third one where cloth
/// folds more tightly than that. Or why that is not known.
std::string roll_text(const KnownRoll &known);

/// The same, and for each direction from x; D_inf of short rulings by itself.
nlohmann::ordered_json json_rolled(const KnownRoll &known);

/// Cells with more triangles are left to `homespun homogenize`: these take less than a second.
constexpr int most_triangles_rolled_at_once = 5000;

/// A warning where cloth folds more tightly than D^H allows, or where that cannot be known; none of
/// cells with more than most_triangles_rolled_at_once.
std::vector<homogenization::Finding> findings_of_folds(const homogenization::UnitCell &cell);
} // namespace homespun::verification
