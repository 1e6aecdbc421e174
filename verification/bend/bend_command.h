// SPDX-License-Identifier: MIT
// `homespun bend`.
#pragma once

#include "verification/bend/bend_study.h"
#include "verification/bend/bend_tables.h"
#include "verification/command/command.h"

namespace homespun::verification
{
struct BendCommand
{
  using Options = BendStudyOptions;
  using Tables  = TablesOf<BendRow, WrinkleRow>;
  static void add(CommandLine &line);
  static constexpr auto run = run_bend_study;
};
} // namespace homespun::verification
