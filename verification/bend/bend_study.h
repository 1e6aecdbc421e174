// SPDX-License-Identifier: MIT
// homespun bend: error of an up-sampled sheet that bends against its curvature.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The names of bending_loads.
std::vector<std::string> names_of_bending_loads();

/// Plates in linear theory; cloths of the law `biot` at large turns.
inline constexpr std::array<const char *, 2> bending_references = {"linear", "biot"};

struct BendStudyOptions : StudyOptions
{
  int n_cells                         = 10; ///< per side of the sheet
  std::vector<std::string> loads      = names_of_bending_loads();
  std::vector<std::string> references = {"linear"};                   ///< of bending_references
  std::vector<double> curvatures = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5}; ///< x cell side, ascending
  int n_cells_of_error_bar       = 3; ///< per side of the small sheet of the error bars
};

/// 5 x 5 cells: seconds.
void make_quick(BendStudyOptions &options);

/// Runs the study and writes, into the output folder, bend.csv, the folders of the cells,
/// verdicts.json and study.json. Loads that are complete are not solved again.
/// @throws BadInput, NotConverged
std::vector<Verdict> run_bend_study(const BendStudyOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
