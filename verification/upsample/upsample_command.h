// SPDX-License-Identifier: MIT
// `homespun upsample`, which solves nothing and needs no deal.II.
#pragma once

#include "verification/command/command.h"
#include "verification/upsample/upsample_tables.h"

namespace homespun::verification
{
struct UpsampleCommand : CommandOfNoStudy
{
  using Tables = TablesOf<UpsampleRow>;
  static void add(CommandLine &line);
};
} // namespace homespun::verification
