// SPDX-License-Identifier: MIT
// The reference judged apart from every other solution: its energy in linear theory held between
// the energies of displacements and of self-equilibrated stresses (equilibrated_sheet.h), on a
// sheet of its own.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/record/verdict.h"
#include "verification/reference/loads.h"
#include "verification/strain/budget/budget_tables.h"

#include <mpi.h>

#include <vector>

namespace homespun::verification
{
/// Solves a sheet of n_cells x n_cells by P1, P2 and stresses, on all ranks but for the stresses.
/// @param load of a sheet
/// @return known on the first rank alone
CrossCheckRow energy_sides(const homogenization::UnitCell &cell, const Load &load, int n_cells,
                           MPI_Comm communicator);

/// Adds the row of a load where it is missing, measured on a sheet that costs little: 4 x 4 cells,
/// or fewer where the study has fewer.
/// @param n_cells per side of the study's sheet
/// @param table cross-checks.csv on the first rank, elsewhere null
void measure_energies(const homogenization::UnitCell &cell, const Load &load, int n_cells,
                      Table<CrossCheckRow> *table, MPI_Comm communicator);

/// Judges each row of energies:
/// - the energy of the reference is not below that of the stress: minimum principles, to round-off
/// - the energy of P2 on the same mesh lies between them: its space holds that of P1
/// - the energy of the reference, from its positions and the phases of the cell, equals half of the
///   work that Clapeyron's theorem has for a minimum, to what the forces left by its solver
///   explain. The sides alone would pass a displacement that solves another problem, such as
///   exchanged phases: any displacement lies above
/// INCONCLUSIVE where a solver did not converge. How far apart the sides are has no limit in
/// theory: it is a number.
std::vector<Verdict> energy_verdicts(const std::vector<CrossCheckRow> &rows);
} // namespace homespun::verification
