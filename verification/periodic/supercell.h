// SPDX-License-Identifier: MIT
// The pattern that a cloth takes when its periodic state is lost to a wave of finite length: an
// equilibrium of the cells over which that wave repeats, found from the periodic state with a
// little of the wave added.
#pragma once

#include "verification/periodic/bloch_margin.h"

#include <optional>

namespace homespun::verification
{
/// n1 x n2 cells as one.
struct Supercell
{
  /// @param cell whose mesh, lattice and anchor are used
  /// @throws BadInput where cells of this outline make no parallelogram, see require_sheets()
  Supercell(const meshes::HomogenizedCell &cell, const Eigen::Vector2i &n);

  /// The waves that repeat over it, one of k and −k, without k = 0.
  std::vector<Wave> waves() const;

  /// A state of the cell, repeated.
  CellEquilibrium repeated(const CellEquilibrium &state) const;

  /// The real part of a field on a wave of the cell, zero at the anchor; its largest displacement
  /// is one.
  meshes::Points real_part(const Mode &mode, const Wave &wave) const;

  meshes::HomogenizedCell cell; ///< mesh, lattice and anchor of all of them
  Eigen::Vector2i n;

private:
  Eigen::VectorXi cell_vertex;                      ///< (n) vertex of the one cell
  Eigen::Matrix<int, Eigen::Dynamic, 2> of_lattice; ///< (n,2) lattice vectors from it
};

/// A state with a pattern beside the periodic one, at the same strain and stresses of the sides.
struct Pattern
{
  CellEquilibrium periodic; ///< of all cells
  CellEquilibrium state;
  Margin wave; ///< lowest of those that repeat over the supercell

  /// What it has less energy, relative to that of the periodic state.
  double lower() const
  {
    return (periodic.energy - state.energy) / periodic.energy;
  }
};

/// Follows the lowest wave of a supercell from a periodic state to where the energy ends to fall.
/// @param one margins of the cell
/// @param loads of the path that the state belongs to
/// @return nothing where no wave of the supercell is below zero: the periodic state is a minimum
/// @throws NotConverged
std::optional<Pattern> followed_pattern(const BlochMargin &one, const Supercell &supercell,
                                        const CellEquilibrium &state, const DeadLoads &loads);
} // namespace homespun::verification
