// SPDX-License-Identifier: MIT
// A scene run: the coarse cloth with the effective stiffness of each cell, up-sampled every step; beside it
// the full-resolution cloth, in the same code or by finite elements; the error of every vertex over time.
#pragma once

#include "verification/record/run_folder.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
struct DrapeOptions
{
  std::string scene_file;
  std::vector<std::string> cell_files; ///< in place of the scene's; empty: the scene's
  std::vector<std::string> variants, references, methods;
  std::vector<std::string> frames = {"vtu"}; ///< of vtu, ply, obj; empty: none
  int n_cells                     = 0;       ///< cells per side of a sheet; 0: the scene's
  int n_cells_of_error_bar        = 4;       ///< 0: no error bar
  double time_step = 0., duration = 0.;      ///< [s]; 0: the scene's
  bool costs = false;                        ///< what absent terms would cost
  std::string output, command;
  Earlier earlier = Earlier::keep_work;
  bool quiet      = false;
};

/// Runs a scene and writes drape.csv, motion.csv, drape.json, terms.csv, verdicts.json and the
/// frames. References go on from the last frame that a run which was killed left; coarse cloths,
/// which take seconds, are run again.
/// @throws BadInput with one message per fault before anything is written
std::vector<Verdict> run_drape_study(const DrapeOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
