// SPDX-License-Identifier: MIT
// What every study of cells is told.
#pragma once

#include "verification/record/run_folder.h"

#include <string>
#include <vector>

namespace homespun::verification
{
struct StudyOptions
{
  std::vector<std::string> cell_files;
  std::string output;
  std::string command; ///< that reproduces the study
  Earlier earlier = Earlier::keep_work;
  bool quiet      = false;
};
} // namespace homespun::verification
