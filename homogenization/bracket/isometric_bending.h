// SPDX-License-Identifier: MIT
// The limit of a cell that is rolled ever more tightly: bending without stretching. Along each
// straight line that stays straight (ruling) the curvature is one number, so that the phases on it
// bend alike, and only lines side by side share the bending as they like:
//   D_inf(n) = harmonic mean over the offset s = n.y of the mean of D_nn along the ruling at s,
// D_nn = (n (x) n).D.(n (x) n), holes counting as zero. A deflection phi(s) does that, and the
// displacement along n takes its strain back. So D^H_nn <= D_eff(R) <= D_inf(n) at every radius.
// Rulings that are no lattice direction come near every offset: their means are all the plain one.
// D_inf therefore jumps from direction to direction.
// Sources: S. Neukamm and H. Olbermann, Calc. Var. 53 (2015); K. D. Cherdantsev and
// M. I. Cherednichenko, Calc. Var. 54 (2015).
#pragma once

#include "homogenization/bracket/plate_mesh.h"
#include "meshes/plain/lattice.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::homogenization
{
struct IsometricBending
{
  std::array<int, 2> ruling; ///< in lattice vectors, coprime
  double angle;              ///< of n from x, in [0, pi) [rad]
  double stiffness;          ///< D_inf(n) [N m]
};

/// D_inf of a sheet whose rulings run along p a1 + q a2, exactly on these triangles.
/// @param bending_stiffness_of_material D [N m]
IsometricBending
isometric_bending(const PlateMesh &mesh, const meshes::Lattice &lattice,
                  const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
                  const std::array<int, 2> &ruling);

/// The rulings of few of the shortest lattice vectors, no number above four, whatever basis the
/// lattice is given by: along others the means differ little.
std::vector<std::array<int, 2>> short_rulings(const meshes::Lattice &lattice);
} // namespace homespun::homogenization
