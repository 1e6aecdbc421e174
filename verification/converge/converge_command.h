// SPDX-License-Identifier: MIT
// `homespun converge`.
#pragma once

#include "verification/command/command.h"
#include "verification/converge/converge_study.h"
#include "verification/converge/converge_tables.h"

namespace homespun::verification
{
struct ConvergeCommand
{
  using Options = ConvergenceStudyOptions;
  using Tables  = TablesOf<ConvergeRow>;
  static void add(CommandLine &line);
  static constexpr auto run = run_convergence_study;
};
} // namespace homespun::verification
