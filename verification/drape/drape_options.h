// SPDX-License-Identifier: MIT
// What a scene run is asked for.
#pragma once

#include "verification/record/run_folder.h"

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
  int n_cells_of_error_bar        = 2;       ///< 0: no error bar
  double time_step = 0., duration = 0.;      ///< [s]; 0: the scene's
  bool costs = false;                        ///< what absent terms would cost
  std::string output, command;
  Earlier earlier = Earlier::keep_work;
  bool quiet      = false;
};
} // namespace homespun::verification
