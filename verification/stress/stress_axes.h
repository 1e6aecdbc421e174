// SPDX-License-Identifier: MIT
// What makes a cell problem hard, one parameter at a time: contrast, Poisson's ratio, anisotropy,
// slivers, size. Along each axis C^H is held against theory (stress.csv), and iterations and times
// of the solver are measured, which have no limit (solver.csv).
#pragma once

#include "verification/stress/stress_cells.h"

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What C^H must be.
enum class Theory
{
  laminate,    ///< the closed form of two layers of half the cell each
  direct_solve ///< the same discrete problem by a sparse factorization, apart from deal.II
};

/// A cell that becomes harder with a parameter.
struct CellAxis
{
  std::string parameter; ///< contrast, poisson, anisotropy, sliver, triangles
  std::string cell;
  Theory theory;
  std::vector<double> values;
  /// @param rows of triangles along a side, where the mesh is made
  std::function<UnitCell(double value, int rows)> make;
};

/// The axes of cells that are made, and the contrast of each given cell that has any.
std::vector<CellAxis> cell_axes(const std::vector<UnitCell> &given);

/// C^H of linear elements along the axes, on one rank.
/// @param most_triangles of the largest cell
std::vector<StressCase> axis_cases(const std::vector<CellAxis> &axes, int most_triangles);

/// One row of solver.csv, to be measured.
struct SolverMeasurement
{
  SolverRow keys; ///< parameter, value, cell and order
  std::function<SolverRow(int repeats)> run;
};

/// P1 and P2 along the axes, up to cells of 1e4 triangles.
std::vector<SolverMeasurement> solver_measurements(const std::vector<CellAxis> &axes);
} // namespace homespun::verification
