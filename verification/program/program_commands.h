// SPDX-License-Identifier: MIT
// The commands that run no study: `homespun check`, `cells` and `report`.
#pragma once

#include "verification/command/command.h"

namespace homespun::verification
{
struct CheckCommand : CommandOfNoStudy
{
  static void add(CommandLine &line);
};

struct CellsCommand : CommandOfNoStudy
{
  static void add(CommandLine &line);
};

struct ReportCommand : CommandOfNoStudy
{
  static void add(CommandLine &line);
};
} // namespace homespun::verification
