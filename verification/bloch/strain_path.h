// SPDX-License-Identifier: MIT
// The periodic states of an infinite cloth along a load, at any strain, pulled or pressed.
#pragma once

#include "verification/periodic_cell/cell_equilibrium.h"
#include "verification/reference/loads.h"

#include <map>

namespace homespun::verification
{
/// Follows one branch from rest; keeps what it found.
class StrainPath
{
public:
  /// @param assembly lives as long as this
  /// @param load of an infinite cloth
  /// @throws BadInput where it is a load of a sheet
  StrainPath(const CellAssembly &assembly, const Load &load);

  /// Newton's method in steps of at most two percent from the state that is nearest, each from the
  /// line through two states; a step that does not converge is cut in two, up to five times.
  /// @param strain fraction, negative where the cloth is pressed
  /// @throws NotConverged
  const CellEquilibrium &at(double strain);

  /// What is free of stress along it.
  const DeadLoads &dead_loads() const
  {
    return loads;
  }

private:
  CellEquilibrium guess(double strain) const;

  const CellAssembly &assembly;
  const Load load;
  DeadLoads loads;
  std::map<double, CellEquilibrium> known; ///< by strain
};
} // namespace homespun::verification
