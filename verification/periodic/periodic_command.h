// SPDX-License-Identifier: MIT
// `homespun periodic`, studies of an infinite cloth, in its two forms `load` and `stability`.
#pragma once

#include "verification/command/command.h"
#include "verification/periodic/periodic_study.h"
#include "verification/periodic/periodic_tables.h"

namespace homespun::verification
{
/// The command of both, added where it is not there yet.
CLI::App &periodic(CommandLine &line);

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
  using Tables  = TablesOf<StabilityRow>;
  static void add(CommandLine &line);
  static constexpr auto run = run_stability_study;
};
} // namespace homespun::verification
