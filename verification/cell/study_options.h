// SPDX-License-Identifier: MIT
// What every study of cells is told.
#pragma once

#include "verification/record/earlier.h"

#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
class AssessedCells;

struct StudyOptions
{
  std::vector<std::string> cell_files;
  std::string output;
  std::string command; ///< that reproduces the study
  Earlier earlier = Earlier::keep_work;
  bool is_quick   = false; ///< small sizes: seconds to minutes
  bool quiet      = false;
  /// Cells that another study of the same run has homogenized; nothing: there is no other.
  std::shared_ptr<AssessedCells> homogenized;
};
} // namespace homespun::verification
