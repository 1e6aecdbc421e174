// SPDX-License-Identifier: MIT
// The Bloch margin of a periodic state: by how much its stiffness is positive definite on waves of
// every length, relative to the stiffness at rest.
//
//   beta = inf over k != 0 of the least eigenvalue of K(k) v = beta K0(k) v,
//     the limits k -> 0 along each direction among them
//
// Scale free, and 1 at rest. beta > 0: the second variation is positive on every supercell, the
// periodic state is a strict local minimum there, and the homogenized tangent is strongly elliptic.
// beta < 0 first in the limit of long waves: the macroscopic law localizes; at a k of finite
// length: a pattern of period 1/k. Geymonat, Müller and Triantafyllidis, Arch. Rational Mech. Anal.
// 122, 1993; Triantafyllidis, Nestorović and Schraad, J. Appl. Mech. 73, 2006; Bertoldi and Boyce,
// Phys. Rev. B 78, 2008.
//
// Fields of a finite mesh are some of all fields: its beta lies above that of the cell. What is
// negative is proved for the discrete state; what is positive holds up to the mesh, and at the
// waves that were asked.
#pragma once

#include "verification/periodic/margin_search.h"
#include "verification/periodic_cell/cell_equilibrium.h"

#include <vector>

namespace homespun::verification
{
/// A cell whose states are asked; keeps what they share.
class BlochMargin
{
public:
  explicit BlochMargin(CellAssembly assembly);

  /// beta over waves_of_the_zone(), and then around the lowest of them in steps that halve from
  /// 1/16 to 1/128 of the reciprocal vectors, or from 7.5 to about 1 degree.
  /// @param near a margin of a state close by: its field gives an upper side at once
  /// @throws NotConverged
  Margin of(const CellEquilibrium &state, const Margin *near = nullptr) const;

  /// beta over some waves alone.
  Margin of(const CellEquilibrium &state, const std::vector<Wave> &waves) const;

  /// Waves of a state, one by one.
  MarginSearch search(const CellEquilibrium &state) const;

  const CellAssembly assembly;

private:
  CellAssembly::Sparse stiffness(const CellEquilibrium &state) const;

  const BlochPencil pencil;
};
} // namespace homespun::verification
