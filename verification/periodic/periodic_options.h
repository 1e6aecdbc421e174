// SPDX-License-Identifier: MIT
// What studies of an infinite cloth are told.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/periodic/load_control.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
struct PeriodicStudyOptions : StudyOptions
{
  std::vector<std::string> laws; ///< none: the default of each cell
};

struct LoadStudyOptions : PeriodicStudyOptions ///< beside its laws `linear` is always there
{
  LoadControl control;
  int n_steps = 20;
  std::vector<std::string> measured; ///< CSV files
};

struct StabilityStudyOptions : PeriodicStudyOptions
{
  std::vector<std::string> loads = {"uniaxial-1", "uniaxial-2"}; ///< of an infinite cloth
  std::vector<double> strains    = {-0.02, -0.05, -0.1, -0.15, -0.2};
  int n_refinements              = 1; ///< 0: the given mesh alone
  /// Cells along a1 and a2 that are solved as one beyond the first loss; nothing: those over which
  /// the lowest wave repeats.
  std::optional<Eigen::Vector2i> supercell;
};
} // namespace homespun::verification
