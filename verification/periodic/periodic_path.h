// SPDX-License-Identifier: MIT
// The periodic states of an infinite cloth along a path from rest: what is prescribed of it, at any
// factor.
#pragma once

#include "verification/periodic/load_control.h"
#include "verification/periodic_cell/cell_equilibrium.h"

#include <map>
#include <optional>
#include <utility>

namespace homespun::verification
{
/// How far a path goes at once, and how often that is cut in two where it does not converge.
struct PathSteps
{
  double longest; ///< in the factor of what is prescribed
  unsigned int most_halvings;
};

/// Follows one branch from rest; keeps what it found.
class PeriodicPath
{
public:
  /// @param assembly lives as long as this
  PeriodicPath(const CellAssembly &assembly, const LoadControl &control, PathSteps steps);

  /// Newton's method from the state that is nearest, step by step, each from the line through the
  /// two nearest states.
  /// @param factor of what is prescribed, also negative
  /// @throws NotConverged
  const CellEquilibrium &at(double factor);

  /// The first factor whose state has left the path: Newton's method from there, taken back to the
  /// state before, comes to another one. Beyond it the states are equilibria, but not those that
  /// what is prescribed leads to. Nothing where each step can be taken back: where the path has no
  /// minimum, rounding decides which equilibrium is found, and a jump may be told late or not.
  /// @param sign of the factors that are asked, 1 or -1
  std::optional<double> left_at(double sign) const;

private:
  using Known = std::map<double, CellEquilibrium>; ///< by factor

  /// The nearest state and the next one, which may be none.
  std::pair<Known::const_iterator, Known::const_iterator> nearest(double factor) const;
  CellEquilibrium guess(double factor) const;
  CellEquilibrium prescribed(CellEquilibrium state, Eigen::Vector3d strain, double factor) const;

  const CellAssembly &assembly;
  const LoadControl control;
  const PathSteps steps;
  Known known;
};
} // namespace homespun::verification
