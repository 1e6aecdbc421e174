// SPDX-License-Identifier: MIT
// The claims of a strain study, judged from its rows.
#pragma once

#include "verification/record/claim.h"
#include "verification/strain/strain_tables.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Whether the coarse cloth has the law of a reference, too.
bool is_shared(const std::string &reference);

/// Whether a study was asked for three levels from 1e-4 to 0.1, what decides a slope.
bool decides_slope(const std::vector<double> &strains);

/// The claim by the three smallest levels of at least three. Where the slopes between them differ
/// by more than the limit of the claim it is open, and so it is where they agree on an order
/// between one and two; but not where they fall towards one as those of a first order beside a
/// second do.
/// @param claim its id, whose limit ends with {note} @param strains ascending
Verdict verdict_of_smallest(const std::string &claim, Words words,
                            const std::vector<double> &strains, const std::vector<double> &errors);

/// Judges, for every cell and load among the rows of strain.csv:
/// - every reference: an equilibrium is found at every level. FAIL where it is found at none and
///   the law is not lost, open where some are missing, because a load whose limit was not shown may
///   have one beyond, and the law may end there
/// - periodic loads, reference biot or yarn, the main one of the cell, where the study has three
///   levels from 1e-4 to 0.1: the localized error falls as strain squared, slope 2 +- 0.1; or is
///   zero at each (`solved_to`); or as strain squared or faster at the three smallest levels, where
///   their two slopes agree (verdict_of_smallest()); FAIL where an error is not a number
/// - sheet loads, the same reference: method_verdicts() of gains.h
/// Levels beyond the loss decide no slope.
/// @param strains that the study was asked for: what they cannot decide is no claim
/// @param levels rows of levels.csv
/// @param methods that the study was asked for
std::vector<Verdict> strain_verdicts(const std::vector<StrainRow> &all,
                                     const std::vector<double> &strains,
                                     const std::vector<LevelRow> &levels     = {},
                                     const std::vector<std::string> &methods = {});

/// For every cell, load and nonlinear reference among the rows of levels.csv: each equilibrium that
/// is compared is a minimum of the reference's energy, as long as the law is elliptic. Open where
/// one is not, or is not known to be: what the cloth does there is not what it is compared with.
std::vector<Verdict> stability_verdicts(const std::vector<LevelRow> &all);
} // namespace homespun::verification
