// SPDX-License-Identifier: MIT
// Where a periodic solution stops being the solution: the Bloch margin along loads of an infinite
// cloth, and the strain of first loss.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
struct StabilityStudyOptions : StudyOptions
{
  std::vector<std::string> loads = {"uniaxial-1", "uniaxial-2"}; ///< of an infinite cloth
  std::vector<double> strains    = {-0.02, -0.05, -0.1, -0.15, -0.2};
  std::vector<std::string> laws; ///< none: the default of each cell
  int n_refinements = 1;         ///< 0: the given mesh alone
  /// Cells along a1 and a2 that are solved as one beyond the first loss; nothing: those over which
  /// the lowest wave repeats.
  std::optional<Eigen::Vector2i> supercell;
};

/// Solves on the first rank; writes stability.csv row by row, loss.csv, zone.csv, mode.csv,
/// study.json and verdicts.json. Paths that the same run had finished are taken up.
/// @throws BadInput, NotConverged where the cell cannot be homogenized
std::vector<Verdict> run_stability_study(const StabilityStudyOptions &options,
                                         MPI_Comm communicator);
} // namespace homespun::verification
