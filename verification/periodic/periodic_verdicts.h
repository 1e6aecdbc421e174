// SPDX-License-Identifier: MIT
// The claims of studies of an infinite cloth, and its losses in words.
#pragma once

#include "verification/periodic/bloch_margin.h"
#include "verification/periodic/load_path.h"
#include "verification/periodic/periodic_tables.h"
#include "verification/record/claim.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// The slope of paths at rest is C^H.
/// @param difference largest relative one of an energy
Verdict verdict_on_slope(const std::string &cell, double difference, double limit);

/// Of a path under given stresses and strains: levels that were reached, work and energy, minima.
/// @param of_path its cell, law and method
std::vector<Verdict> verdicts_on_path(const Words &of_path, const CellAssembly &assembly,
                                      const LoadControl &control, const LoadPath &path,
                                      int n_steps);

/// Adds what is owed of the paths of a cell under given stresses and strains: resolved, and with
/// C^H in place of the cell but for the law linear, which is the same.
void add_owed_of_paths(const std::string &cell, const std::vector<std::string> &laws,
                       std::vector<OwedClaim> &owed);

/// Adds what is owed of the margins along a path.
void add_owed_of_margins(const Words &path, int n_refinements, std::vector<OwedClaim> &owed);

/// beta = 1 at rest, by definition, whatever the cell.
Verdict verdict_on_rest(const std::string &cell, const std::string &law, const BlochMargin &bloch);

/// Per path: two sides of beta that meet, the sign of the acoustic tensor, levels that were not
/// reached, meshes that disagree on the sign; and where a wave is below zero there is a state of
/// less energy.
std::vector<Verdict> verdicts_on_margins(const std::vector<StabilityRow> &rows);

/// "honeycomb, biot, uniaxial-1, pressed: lost first at -0.135 +- 0.02, ...", a sentence per path,
/// and one of the pattern with most energy to gain; and what a reader of the table has to know.
std::vector<std::string> notes_on_margins(const std::vector<StabilityRow> &rows);

/// What a reader of load.csv has to know.
std::vector<std::string> notes_on_load(const LoadControl &control, int n_steps);
} // namespace homespun::verification
