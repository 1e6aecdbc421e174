// SPDX-License-Identifier: MIT
// `homespun stress`.
#pragma once

#include "verification/command/command.h"
#include "verification/stress/stress_study.h"
#include "verification/stress/stress_tables.h"

namespace homespun::verification
{
struct StressCommand
{
  using Options = StressStudyOptions;
  using Tables  = TablesOf<LimitRow, StressRow>;
  static void add(CommandLine &line);
  static constexpr auto run = run_stress_study;
};
} // namespace homespun::verification
