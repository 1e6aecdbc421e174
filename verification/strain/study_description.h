// SPDX-License-Identifier: MIT
// What a strain study says of itself: how it was made, what it left out and why, how its numbers
// came to be. Every sentence follows from what ran.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/cell/study_of_cells.h"
#include "verification/strain/strain_options.h"
#include "verification/strain/strain_tables.h"


#include <string>
#include <vector>

namespace homespun::verification
{
struct StudyCost
{
  double peak_memory      = 0.; ///< of all ranks together [B]
  double largest_residual = 0.; ///< of the references, relative
};

/// What ran.
struct StudyRecord
{
  const std::vector<StrainRow> &rows;
  const std::vector<LevelRow> &steps;
  std::vector<std::string> notes; ///< on levels and on the budget
};

/// What study.json says of it.
/// @param options with the references of all cells
StudyDescription describe(const StrainStudyOptions &options, const StudyRecord &record,
                          const StudyCost &cost);

/// All that the numbers of a study depend on beside its cells.
/// @param asked references empty: those of each cell
nlohmann::ordered_json strain_inputs(const StrainStudyOptions &asked,
                                     const std::vector<homogenization::UnitCell> &cells);
} // namespace homespun::verification
