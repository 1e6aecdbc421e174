// SPDX-License-Identifier: MIT
// `homespun verify`.
#pragma once

#include "verification/command/command.h"
#include "verification/verify/verify_study.h"

namespace homespun::verification
{
struct VerifyCommand
{
  using Options = VerifyOptions;
  using Tables  = TablesOf<>;
  static void add(CommandLine &line);
  static constexpr auto run = verify;
};
} // namespace homespun::verification
