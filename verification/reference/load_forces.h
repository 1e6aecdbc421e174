// SPDX-License-Identifier: MIT
// What a load takes: the forces of the clamps of a sheet, and the mean stress. Of every cloth that
// a load moves, resolved or coarse, by the same definition.
//
// The force of a clamp is the sum of dE/dx over the vertices that it holds. Along the motion of the
// clamp, by the length d that it has moved, it is therefore the derivative of the energy at
// equilibrium, F = dE/dd: its error has the order of the energy's.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/law/laws.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::verification
{
/// What a cloth under a load asks for.
struct LoadForces
{
  /// Rows: what the clamp that stays and the one that moves exert on the sheet; zero of an infinite
  /// cloth [N].
  Eigen::Matrix2d on_clamps = Eigen::Matrix2d::Zero();
  /// Mean of the nominal stress P = dW/dF over the rest area: P_ij is the force along axis i on the
  /// rest length of a cut normal to axis j [N/m].
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();
};

/// Force that the moving clamp exerts along its motion, positive where it does work on the cloth;
/// of an infinite cloth, which has no clamp, not a number [N].
/// @param sides rows: the sides of the sheet at rest [m]
double force_along(const Load &load, const Eigen::Matrix2d &sides, const LoadForces &forces);

/// The same per rest width of the clamped edge; of an infinite cloth the component of the nominal
/// stress that does the work, P : dF/d(strain) [N/m].
double force_per_width(const Load &load, const Eigen::Matrix2d &sides, const LoadForces &forces);

/// From the derivatives dE/dx of the energy at the vertices of a sheet, or of one cell of an
/// infinite cloth. The mean stress is that of Signorini: the sum of dE/dx_i X_j over the rest area.
/// @param rest (n,2) vertices at rest [m]
/// @param gradient (n,2) dE/dx [N]
LoadForces load_forces(const Load &load, const meshes::Sheet &sheet, const meshes::Points &rest,
                       const meshes::Points &gradient);

/// Energy and mean stress of a resolved sheet whose vertices are somewhere, in equilibrium or not.
struct SheetEnergy
{
  double energy          = 0.;                      ///< [J]
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero(); ///< mean of P over the rest area [N/m]
};

/// By linear triangles, on the mesh of the sheet.
/// @param stiffness_of_phase (3,3) [N/m]
/// @param positions (n,2) [m]
SheetEnergy sheet_energy(const meshes::Sheet &sheet,
                         const std::vector<Eigen::Matrix3d> &stiffness_of_phase, Law law,
                         const meshes::Points &positions);
} // namespace homespun::verification
