// SPDX-License-Identifier: MIT
// Error against strain (the paper's Figure 3): for each cell, load, reference law and strain the
// resolved solution, and the distance of every method from it at every vertex.
#pragma once

#include "verification/record/verdict.h"
#include "verification/strain/strain_options.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Runs a study and writes, into the output folder, strain.csv, levels.csv, uncertainty.csv,
/// budget.csv, cross-checks.csv, runtime.csv, validity.csv, verdicts.json, study.json and per cell
/// what homogenize writes and fields-LOAD.h5. Rows are on the disk as they come; what the same run
/// left there is not computed again.
///
/// The cell is homogenized with P1 on its given mesh, the discretization of the reference, so that
/// the figure shows the error of the method and not of two different meshes.
/// @throws BadInput, NotConverged
std::vector<Verdict> run_strain_study(const StrainStudyOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
