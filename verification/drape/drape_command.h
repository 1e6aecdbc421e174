// SPDX-License-Identifier: MIT
// `homespun drape`.
#pragma once

#include "verification/command/command.h"
#include "verification/drape/drape_study.h"
#include "verification/drape/drape_tables.h"

namespace homespun::verification
{
struct DrapeCommand
{
  using Options = DrapeOptions;
  using Tables  = TablesOf<DrapeRow, MotionRow, TermRow>;
  static void add(CommandLine &line);
  static constexpr auto run = run_drape_study;
};
} // namespace homespun::verification
