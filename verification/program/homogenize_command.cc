// SPDX-License-Identifier: MIT
#include "verification/program/homogenize_command.h"

#include "homogenization/lint/cell_reading.h"
#include "verification/cell/cell_summary.h"
#include "verification/record/on_root.h"
#include "verification/record/run_folder.h"

#include <iostream>

namespace homespun::verification
{
int homogenize_cell(const HomogenizeArguments &arguments)
{
  const homogenization::UnitCell cell = homogenization::read_unit_cell(
    arguments.file, MPI_COMM_WORLD, is_root(MPI_COMM_WORLD) ? &std::cerr : nullptr);
  CellStudyOptions study = arguments.study;
  study.uncertain        = uncertain_inputs(cell, arguments.uncertain);
  if (study.output.empty())
    study.output = default_folder("homogenize", {cell.name});
  const AssessedCell assessed = run_cell_study(cell, study, MPI_COMM_WORLD);
  if (is_root(MPI_COMM_WORLD) && !study.quiet)
    std::cout << summary(cell, assessed, study.uncertain) << "Written to " << study.output
              << ": homogenize.json, cell.h5, cell.json, characteristic-displacements.vtu"
              << (assessed.bending && assessed.bending->bracket
                    ? ", shell-section-abaqus.inp, shell-section-code_aster.comm"
                    : "")
              << (study.pieces ? ", characteristic-displacements-refined.pvtu\n" : "\n");
  return status_of(assessed.checks);
}
} // namespace homespun::verification
