// SPDX-License-Identifier: MIT
// The claims of a stability study, from its rows, and its losses in words.
#pragma once

#include "verification/bloch/bloch_margin.h"
#include "verification/bloch/pattern_tables.h"
#include "verification/bloch/stability_tables.h"
#include "verification/record/verdict.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// beta = 1 at rest, by definition, whatever the cell.
Verdict verdict_on_rest(const std::string &what, const BlochMargin &bloch,
                        const CellAssembly &assembly);

/// Per path: two sides of beta that meet, the sign of the acoustic tensor, levels that were not
/// reached, and meshes that disagree on the sign.
std::vector<Verdict> verdicts_on_rows(const std::vector<StabilityRow> &levels,
                                      const std::vector<LossRow> &losses);

/// "honeycomb, biot, uniaxial-1, pressed: lost first at -0.135 +- 0.02, ...", a sentence per path.
std::vector<std::string> notes_on_losses(const std::vector<LossRow> &losses);

/// Per path: where a wave is below zero there is a state of less energy.
std::vector<Verdict> verdicts_on_patterns(const std::vector<PatternRow> &patterns);

/// A sentence per path, of the pattern with most energy to gain.
std::vector<std::string> notes_on_patterns(const std::vector<PatternRow> &patterns);
} // namespace homespun::verification
