// SPDX-License-Identifier: MIT
// The references of a strain study, cell by cell: those that are asked for, or where none are,
// those of each cell's default law.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/law/laws.h"
#include "verification/strain/strain_options.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// What is asked for, with the references of a cell.
StrainStudyOptions options_of(const StrainStudyOptions &asked,
                              const homogenization::UnitCell &cell);

/// What is asked for, with the references of all cells, each once.
StrainStudyOptions options_of(const StrainStudyOptions &asked,
                              const std::vector<homogenization::UnitCell> &cells);

/// How many references a cell has.
std::size_t references_per_cell(const StrainStudyOptions &asked);

/// @param options with references
std::vector<Law> laws_of(const StrainStudyOptions &options);

/// A sentence on each cell whose law nobody asked for: which, why, and what it leaves out.
std::vector<std::string> notes_on_references(const StrainStudyOptions &asked,
                                             const std::vector<homogenization::UnitCell> &cells);
} // namespace homespun::verification
