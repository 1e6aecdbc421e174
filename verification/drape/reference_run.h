// SPDX-License-Identifier: MIT
// A full-resolution cloth of a scene over all its frames, and the errors of every coarse run
// against it, frame by frame.
#pragma once

#include "verification/drape/drape_errors.h"
#include "verification/drape/drape_run.h"
#include "verification/record/json_files.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// The coarse runs of a cell, and what holds them against references.
struct CoarseRuns
{
  std::vector<CoarseRun> all;
  std::unique_ptr<DrapeComparison> comparison; ///< on the first rank
};

/// Runs it from the frame that an earlier process left, and writes its rows, frames, states and
/// claims. It ends, with a note, at a frame that it does not reach. All ranks call this.
/// @param reference `shell` or the name of a law
/// @return what drape.json says of it
nlohmann::ordered_json run_reference(DrapeRun &run, const DrapedCell &draped,
                                     const std::string &reference, const CoarseRuns &coarse);
} // namespace homespun::verification
