// SPDX-License-Identifier: MIT
#pragma once

#include "verification/command/command.h"
#include "verification/judge/judge_study.h"

namespace homespun::verification
{
struct JudgeCommand
{
  using Options = JudgeOptions;
  using Tables  = TablesOf<>; // those of the study that it adds a method to
  static void add(CommandLine &line);
  static constexpr auto run = judge;
};
} // namespace homespun::verification
