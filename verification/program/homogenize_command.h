// SPDX-License-Identifier: MIT
// What `homespun homogenize` does.
#pragma once

#include "verification/cell/cell_study.h"

#include <string>

namespace homespun::verification
{
struct HomogenizeArguments
{
  std::string file, uncertain;
  CellStudyOptions study;
};

/// Homogenizes a cell and prints its summary, on all ranks.
/// @return the exit status of its checks
/// @throws BadInput where cell or arguments are not sound
int homogenize_cell(const HomogenizeArguments &arguments);
} // namespace homespun::verification
