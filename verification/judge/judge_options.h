// SPDX-License-Identifier: MIT
// What `homespun judge` is told.
#pragma once

#include "verification/cell/study_options.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
struct JudgeOptions : StudyOptions
{
  std::string run;                ///< folder of a `strain --keep`
  std::vector<std::string> files; ///< of positions, and folders of such
  std::string method = "mine";    ///< what the method is called
  std::optional<double> seconds;  ///< of one level
};
} // namespace homespun::verification
