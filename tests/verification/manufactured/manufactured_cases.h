// SPDX-License-Identifier: MIT
// Every solver held against motions that it must reproduce with the order of its elements or of its
// time step:
//   references    in the plane (periodic and clamped) and in space (statics, steps)
//   shell         in the plane and in space, one stiffness or a field of them; its integrators
//   homogenizer   a force in the cell; one stiffness, layers, a field
//   up-sampler    the coarse motion is given, nothing is solved
// Limits are one order of theory +- 0.1 on both sides: linear elements in the place of quadratic
// ones FAIL, and so does an integrator of first order in the place of one of second.
#pragma once

#include "localization/options.h"
#include "tests/verification/manufactured/manufactured_motions.h"
#include "verification/record/convergence.h"
#include "verification/reference/known_field.h"

#include <Eigen/Core>
#include <mpi.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace homespun::verification
{
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
  std::string L2_claim;     ///< the same in words
  bool has_H1   = true;     ///< false where only points are compared
  OrderLimit H1 = {0., 0.}; ///< expected order of the H1 error
  std::string theory;       ///< where the orders come from
  /// False where nothing is solved, or by a factorisation: there is no tolerance, and the algebraic
  /// error is round-off.
  bool has_tolerance = true;
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

/// A case whose levels are mesh widths over the side, with the orders of its elements: p + 1 in L2,
/// p in H1.
ManufacturedCase of_elements(const std::string &name, unsigned int order, std::vector<int> sizes);

/// A case whose levels are time steps.
/// @param duration of the motion [s]
ManufacturedCase of_time_steps(const std::string &name, double order, std::vector<int> sizes,
                               double duration);

std::vector<ManufacturedCase> reference_cases();
std::vector<ManufacturedCase> shell_cases();
std::vector<ManufacturedCase> homogenizer_cases();
/// @param options whose strain and lift are those of biot, whose chi is zero at the lattice, and
///   which blend: others are no choice of order 2
std::vector<ManufacturedCase> upsampler_cases(const localization::UpsamplerOptions &options = {});

/// All of them.
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
  /// Algebraic error over the smallest L2 error; not a number where there is no tolerance.
  double algebraic_share;
};
ManufacturedClaims judge(const ManufacturedCase &manufactured, const ManufacturedLadder &ladder);
} // namespace homespun::verification
