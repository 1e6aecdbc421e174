// SPDX-License-Identifier: MIT
// `homespun load` and `homespun stability`: studies of an infinite cloth.
#pragma once

#include "verification/command/command.h"
#include "verification/periodic/periodic_study.h"
#include "verification/periodic/periodic_tables.h"

namespace homespun::verification
{
struct LoadCommand
{
  using Options = LoadStudyOptions;
  using Tables  = TablesOf<LoadRow>;
  static void add(CommandLine &line);
  static constexpr auto run = run_load_study;
};

struct StabilityCommand
{
  using Options = StabilityStudyOptions;
  using Tables  = TablesOf<StabilityRow, ModeRow>;
  static void add(CommandLine &line);
  static constexpr auto run = run_stability_study;
};
} // namespace homespun::verification
