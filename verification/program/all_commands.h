// SPDX-License-Identifier: MIT
// The one list of the commands, in the order of the help: a new one is a folder and a line here.
#pragma once

#include "verification/bend/bend_command.h"
#include "verification/converge/converge_command.h"
#include "verification/drape/drape_command.h"
#include "verification/homogenize/homogenize_command.h"
#include "verification/judge/judge_command.h"
#include "verification/periodic/periodic_command.h"
#include "verification/program/program_commands.h"
#include "verification/strain/strain_command.h"
#include "verification/stress/stress_command.h"
#include "verification/upsample/upsample_command.h"
#include "verification/verify/verify_command.h"

namespace homespun::verification
{
template <typename... Command>
struct Commands
{
  static void add_to(CommandLine &line)
  {
    (Command::add(line), ...);
  }

  /// All that they run, which links deal.II.
  static Studies studies()
  {
    Studies all;
    (all.add<Command>(), ...);
    return all;
  }

  static void add_tables(nlohmann::ordered_json &schema)
  {
    (Command::Tables::add_to(schema), ...);
  }
};

using AllCommands =
  Commands<CheckCommand, CellsCommand, HomogenizeCommand, StrainCommand, BendCommand, JudgeCommand,
           DrapeCommand, UpsampleCommand, LoadCommand, StabilityCommand, ConvergeCommand,
           StressCommand, ReportCommand, VerifyCommand>;
} // namespace homespun::verification
