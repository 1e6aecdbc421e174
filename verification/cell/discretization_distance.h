// SPDX-License-Identifier: MIT
// How far P1 on a mesh is from the limit of fine meshes, from three discretizations: P1, P2, and P2
// on the refined mesh.
#pragma once

#include "homogenization/cell/unit_cell.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::verification
{
/// F where no convergence is seen.
constexpr double safety_unconfirmed = 3.;

/// Measured distances between discretizations of one sheet, means over its vertices, or differences
/// of a number, P1 − P2 and so on; in any unit.
struct DiscretizationDistance
{
  double p1_to_p2 = 0., p1_to_refined = 0., p2_to_refined = 0.;
  bool reached = false; ///< false where one of them found no equilibrium

  /// F (|P1 − refined P2| + |P2 − refined P2| / (2^q − 1)): the distance to the best solution, and
  /// by Richardson how far that one is from the limit. F = 1.25 as in the grid convergence index
  /// (record/convergence.h) where the distances fall along the ladder; where |P2 − refined P2| is
  /// not smaller than |P1 − P2| no convergence is seen, and F = 3, as Roache (1994) asks of two
  /// meshes whose order is not confirmed.
  /// @param order q of P2 on uniformly refined meshes
  double uncertainty(double order) const;

  double safety() const; ///< F
};

/// The highest order of P2 displacements: of smooth solutions, and of sheets whose clamped and free
/// edges meet, where the exponent of the corner lies above ½.
constexpr double order_of_p2_smooth = 3., order_of_p2_sheet = 1.;

/// That of an energy, and of what is its derivative, where the solution is smooth; twice the
/// exponent of a corner bounds it like that of displacements.
constexpr double order_of_p2_energy = 4.;

/// The order in which P2 displacements converge on uniformly refined meshes, in the mean: twice the
/// exponent of the strongest corner of the cell, and at most `highest`.
double order_of_p2(const homogenization::UnitCell &cell, double highest);

/// The same, at the corners where phases of other stiffnesses meet.
double order_of_p2(const homogenization::UnitCell &cell,
                   const std::vector<Eigen::Matrix3d> &stiffness_of_phase, double highest);

/// 1.25 / (1 - 2^-q): by it the distance from the once refined mesh is the error of the given one,
/// with a margin (grid convergence index).
double factor_of_bars(double order);

/// Its q twice the exponent of the strongest corner and at most 2, the order of the energy of P1.
double factor_of_bars(const homogenization::UnitCell &cell);
} // namespace homespun::verification
