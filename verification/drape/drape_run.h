// SPDX-License-Identifier: MIT
// What the cloths of one run of a scene share.
#pragma once

#include "verification/drape/drape_options.h"
#include "verification/drape/drape_output.h"
#include "verification/drape/drape_schedule.h"
#include "verification/record/progress.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
struct DrapeRun
{
  const DrapeOptions &options;
  const DrapeSchedule schedule;
  const MPI_Comm communicator;
  Progress progress;
  std::vector<Verdict> &verdicts;           ///< of the study
  std::string name                    = {}; ///< hash of what it is made of
  std::unique_ptr<DrapeOutput> output = {}; ///< on the first rank
  std::vector<std::string> notes      = {};

  /// For the terminal and for drape.json.
  void note(const std::string &text)
  {
    progress.note(text);
    notes.push_back(text);
  }
};
} // namespace homespun::verification
