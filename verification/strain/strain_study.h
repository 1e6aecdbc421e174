// SPDX-License-Identifier: MIT
// Error against strain (the paper's Figure 3): for each cell, load, reference law and strain the
// resolved solution, and the distance of every method from it at every vertex.
#pragma once

#include "verification/record/run_folder.h"
#include "verification/record/verdict.h"

#include <mpi.h>

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

/// The whole study: nine strains from 0.1 to 20 %, every load, reference and method, the paper's size.
StrainStudyOptions default_strain_study();

/// 4 x 4 cells at 0.1, 1 and 10 %: seconds.
void make_quick(StrainStudyOptions &options);

/// Runs a study and writes, into the output folder, strain.csv, steps.csv, uncertainty.csv, budget.csv,
/// runtime.csv, validity.csv, verdicts.json, study.json and per cell what homogenize writes and
/// fields-LOAD.h5. Rows are on the disk as they come; what the same run left there is not computed again.
///
/// The cell is homogenized with P1 on its given mesh, the discretization of the reference, so that
/// the figure shows the error of the method and not of two different meshes.
/// @throws BadInput, NotConverged
std::vector<Verdict> run_strain_study(const StrainStudyOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
