// SPDX-License-Identifier: MIT
// `homespun homogenize`.
#pragma once

#include "verification/command/command.h"
#include "verification/homogenize/homogenize_study.h"

namespace homespun::verification
{
struct HomogenizeCommand
{
  using Options = HomogenizeOptions;
  using Tables  = TablesOf<>;
  static void add(CommandLine &line);
  static constexpr auto run = homogenize_cell;
};
} // namespace homespun::verification
