// SPDX-License-Identifier: MIT
// Every solver held against motions that it must reproduce with the order of its elements or of its
// time step: the references in the plane (periodic and clamped) and the reference in space
// (statics, steps).
#pragma once

#include "verification/record/convergence.h"
#include "verification/reference/field_integrals.h"

#include <Eigen/Core>
#include <mpi.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace homespun::verification
{
/// Side of every sheet [m].
constexpr double manufactured_side = 0.1;

/// Of the residual of all solvers.
constexpr double manufactured_tolerance = 1e-12;

/// A solution on one level.
struct ManufacturedSolution
{
  FieldDistance error; ///< L2 [m^2], H1 [m]; divided by side and side² below
  unsigned long n_dofs = 0;
  Eigen::MatrixXd positions; ///< of the vertices [m]
};

/// A solver with a motion, on a ladder of sizes.
struct ManufacturedCase
{
  std::string name;   ///< solver, load and law
  unsigned int order; ///< P1 or P2
  std::string h_unit; ///< "side" for a mesh width over the side of the sheet, "s" for a time step
  std::vector<int> sizes;   ///< divisions of the side, or time steps
  double extent;            ///< h = extent / size
  OrderLimit L2;            ///< expected order of the L2 error
  bool has_H1   = true;     ///< false in time, where the space is exact
  OrderLimit H1 = {0., 0.}; ///< expected order of the H1 error
  /// Solves with a division and a solver tolerance. @throws NotConverged
  std::function<ManufacturedSolution(int size, double tolerance, MPI_Comm)> solve;
};

/// What a ladder gave.
struct ManufacturedLadder
{
  std::vector<double> h, L2, H1; ///< errors relative to the side of the sheet [-]
  std::vector<unsigned long> n_dofs;
  /// Root mean square over the vertices, relative to the side, of what a hundred times the solver's
  /// tolerance changes on the finest level, or the first power of a hundred that changes anything:
  /// an upper estimate of the algebraic error. Not a number where none does.
  double algebraic_error = std::numeric_limits<double>::quiet_NaN();
  std::string unfinished; ///< why the levels end early; empty where all are solved
};

/// All cases.
const std::vector<ManufacturedCase> &manufactured_cases();

/// Solves a case on all of its levels, or as many as converge.
ManufacturedLadder climb(const ManufacturedCase &manufactured, MPI_Comm communicator);

/// Largest algebraic error, over the smallest L2 error, at which orders are those of the elements.
constexpr double largest_algebraic_share = 0.01;

/// The claims of a ladder: L2 order, H1 order, and the algebraic error at least 100 times below the
/// smallest L2 error; without the last nothing follows from the orders, and what would PASS is
/// INCONCLUSIVE.
struct ManufacturedClaims
{
  OrderJudgement L2, H1;
  double algebraic_share; ///< algebraic error over the smallest L2 error
};
ManufacturedClaims judge(const ManufacturedCase &manufactured, const ManufacturedLadder &ladder);
} // namespace homespun::verification
