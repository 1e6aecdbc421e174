// SPDX-License-Identifier: MIT
// What a scene run is asked for.
#pragma once

#include "verification/cell/study_options.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// cell_files stand in place of the scene's; empty: the scene's.
struct DrapeOptions : StudyOptions
{
  std::string scene_file;
  std::vector<std::string> variants, references, methods;
  std::vector<std::string> frames = {"vtu"}; ///< of vtu, ply, obj; empty: none
  int n_cells                     = 0;       ///< cells per side of a sheet; 0: the scene's
  int n_cells_of_error_bar        = 2;       ///< 0: no error bar
  double time_step = 0., duration = 0.;      ///< [s]; 0: the scene's
  bool keep  = false;                        ///< positions of all frames, for `homespun judge`
  bool costs = false;                        ///< what absent terms would cost
};

/// A sheet of 4 x 4 cells unless another was asked for, without error bar: seconds.
inline void make_quick(DrapeOptions &options)
{
  options.is_quick             = true;
  options.n_cells              = options.n_cells == 0 ? 4 : options.n_cells;
  options.n_cells_of_error_bar = 0;
}
} // namespace homespun::verification
