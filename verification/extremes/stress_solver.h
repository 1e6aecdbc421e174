// SPDX-License-Identifier: MIT
// The cell problem on one rank, apart from deal.II; what the conjugate gradients of the cell
// problem cost against contrast, Poisson's ratio, anisotropy, the quality of slivers and the size
// of the mesh: numbers without a limit, as a table.
#pragma once

#include "verification/extremes/stress_cells.h"
#include "verification/extremes/stress_tables.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What a stress case asks of a homogenization.
struct SolvedCell
{
  Eigen::Matrix3d stiffness, voigt, reuss; ///< [N/m]; reuss is zero where the cell has holes
  unsigned long n_dofs    = 0;
  unsigned int iterations = 0;  ///< the most of the three loads
  double seconds          = 0.; ///< of preconditioner and solve
};

/// Homogenizes a cell on the calling rank alone, with the program's defaults but the order.
/// @throws NotConverged, BadInput
SolvedCell solved(const UnitCell &cell, unsigned int order = 1);

/// One row of solver.csv, to be measured.
struct SolverMeasurement
{
  SolverRow keys; ///< parameter, value, cell and order
  std::function<SolverRow(int repeats)> run;
};

/// All of them: P1 on cells of 48 x 48 x 2 triangles, P2 on 24 x 24 x 2; then the size.
std::vector<SolverMeasurement> solver_measurements();
} // namespace homespun::verification
