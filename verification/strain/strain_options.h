// SPDX-License-Identifier: MIT
// What a strain study is asked for, whole or quick.
#pragma once

#include "verification/record/run_folder.h"

#include <string>
#include <vector>

namespace homespun::verification
{
struct StrainStudyOptions
{
  std::vector<std::string> cell_files;
  int n_cells = 20;            ///< per side of the sheet
  std::vector<double> strains; ///< as fractions, ascending
  std::vector<std::string> loads;
  std::vector<std::string> references;
  std::vector<std::string> methods;
  int n_cells_of_error_bar = 4; ///< per side of the small sheet of the references' error bar
  std::string output;
  std::string command;     ///< that reproduces the study
  bool budget     = true;  ///< budget.csv, the error split into its parts
  bool run_time   = true;  ///< runtime.csv, every way to the positions at one strain
  bool is_quick   = false; ///< the sizes are those of make_quick()
  Earlier earlier = Earlier::keep_work;
  bool quiet      = false;
};

/// The whole study: nine strains from 0.1 to 20 %, every load, reference and method, the paper's
/// size.
StrainStudyOptions default_strain_study();

/// 4 x 4 cells at 0.1, 1 and 10 %: seconds.
void make_quick(StrainStudyOptions &options);
} // namespace homespun::verification
