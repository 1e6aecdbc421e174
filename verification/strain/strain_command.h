// SPDX-License-Identifier: MIT
// `homespun strain`.
#pragma once

#include "verification/command/command.h"
#include "verification/strain/budget/budget_tables.h"
#include "verification/strain/strain_study.h"
#include "verification/strain/strain_tables.h"

namespace homespun::verification
{
struct StrainCommand
{
  using Options = StrainStudyOptions;
  using Tables  = TablesOf<StrainRow, GainRow, LevelRow, ForceRow, UncertaintyRow, BudgetRow,
                          CrossCheckRow, RunTimeRow, ValidityRow>;
  static void add(CommandLine &line);
  static constexpr auto run = run_strain_study;
};
} // namespace homespun::verification
