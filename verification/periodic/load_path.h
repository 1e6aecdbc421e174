// SPDX-License-Identifier: MIT
// The levels of an infinite cloth from rest to what is prescribed, in even steps.
#pragma once

#include "verification/periodic/load_control.h"
#include "verification/periodic_cell/cell_equilibrium.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// An equilibrium on the path.
struct LoadLevel
{
  double factor          = 0.;                      ///< part of what is prescribed, 0 to 1
  Eigen::Vector3d strain = Eigen::Vector3d::Zero(); ///< 11, 22, 12 [-]
  Eigen::Vector3d stress = Eigen::Vector3d::Zero(); ///< nominal [N/m]
  double energy          = 0.;                      ///< per rest area [N/m]
  /// Whether the second derivative by the fluctuation of one cell and the free strains is positive
  /// definite. Modes longer than a cell are not asked.
  bool is_stable = false;
};

struct LoadPath
{
  std::vector<LoadLevel> levels; ///< from the first step on, as many as were reached
  CellEquilibrium last;          ///< the state of the last of them
  std::string why;               ///< the next one was not; empty where all were
};

/// From level to level; a step that does not converge is cut in two, up to three times.
/// @param assembly of the cell, or of a cloth without a microstructure
LoadPath load_path(const CellAssembly &assembly, const LoadControl &control, int n_steps);

/// How far the work of the stresses on the strains is from the derivative of the energy by their
/// factor, and what is to be expected of that.
struct WorkCheck
{
  double work       = 0.; ///< P11 e11 + P22 e22 + P12 e12 [N/m]
  double difference = 0.; ///< [N/m]
  double bar        = 0.; ///< of the central difference: twice the step against once, and rounding
};

/// The energy at strains a little smaller and larger than those of the last level, all prescribed,
/// against its stress. Where it lies beside another equilibrium, or its fluctuation is no minimum,
/// the energies may be those of other states, which the bar shows.
WorkCheck check_work(const CellAssembly &assembly, const LoadControl &control,
                     const LoadPath &path);

/// C^H of the cell: the second derivative of the energy by the strains at rest, P1, Voigt [N/m].
Eigen::Matrix3d stiffness_at_rest(const CellAssembly &assembly);
} // namespace homespun::verification
