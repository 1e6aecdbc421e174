// SPDX-License-Identifier: MIT
// What a strain study is asked for, whole or quick.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/reference/loads.h"

#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
struct StrainStudyOptions : StudyOptions
{
  int n_cells                  = 20;     ///< per side of the sheet
  std::array<int, 2> supercell = {1, 1}; ///< cells that repeat under periodic loads
  std::vector<double> strains;           ///< as fractions, ascending
  std::vector<std::string> loads;
  std::vector<std::string> references; ///< empty: those of each cell, default_references()
  std::vector<std::string> methods;
  int n_cells_of_error_bar = 4;     ///< per side of the small sheet of the references' error bar
  bool budget              = true;  ///< budget.csv, the error split into its parts
  bool run_time            = true;  ///< runtime.csv, every way to the positions at one strain
  bool keep                = false; ///< positions of all levels, for `homespun judge`
};

/// Whether more than one cell repeats under periodic loads.
inline bool has_supercell(const StrainStudyOptions &options)
{
  return options.supercell[0] * options.supercell[1] > 1;
}

/// Whether a load has an error budget: its parts are those of given macro strains and of one cell.
bool has_budget(const StrainStudyOptions &options, const Load &load);

/// Whether a load is one of a sheet.
bool has_sheet(const StrainStudyOptions &options);

/// Whether run times are measured: of sheets, under the law that reference and coarse cloth share.
/// @param options with references
bool has_run_times(const StrainStudyOptions &options);

/// The whole study: nine strains from 0.1 to 20 %, every load and method, the laws of each cell,
/// the paper's size.
StrainStudyOptions default_strain_study();

/// 4 x 4 cells at 0.1, 1 and 10 %: seconds.
void make_quick(StrainStudyOptions &options);
} // namespace homespun::verification
