// SPDX-License-Identifier: MIT
// Modes that are fitted to the equilibria of a cell over a box of macro strains
// (meshes/plain/fitted_modes.h): what chi leaves of the fluctuations at sampled strains, each
// weighted by its own size, its largest singular directions as modes, their coefficients by least
// squares; and what the fit leaves at strains that it has not seen.
#pragma once

#include "meshes/plain/fitted_modes.h"
#include "meshes/plain/homogenized_cell.h"
#include "verification/periodic_cell/nonlinear_cell.h"

#include <Eigen/Core>

namespace homespun::verification
{
/// A box of macro strains U − I, and how densely it is sampled.
struct StrainBox
{
  Eigen::Vector3d low, high; ///< 11, 22, 12; rest within
  int n_fitted = 120, n_held_out = 20;
};

/// The box of a cloth that is pulled and sheared up to a strain: pressed across by no more than a
/// third of it, and under a law of yarns, which kink where they are pressed, not at all.
StrainBox box_up_to(double strain, Law law);

struct ModeFit
{
  meshes::FittedModes modes;
  int n_fitted = 0, n_held_out = 0; ///< strains at which the cell has an equilibrium
  /// Mean |error of w| over mean |w| at the strains that were held out, all together: of these
  /// modes, of chi alone [-].
  double left = 0., left_by_chi = 0.;
};

/// @param nonlinear the cell under its law
/// @param cell whose chi and C^H stand beside the modes
/// @throws NotConverged where the cell has an equilibrium at less than half of the strains
ModeFit fit_modes(const NonlinearCell &nonlinear, const meshes::HomogenizedCell &cell,
                  const StrainBox &box);

/// Triangles of a coarse mesh whose strain lies outside of the box.
/// @param positions (n,2) [m]
int n_outside(const meshes::FittedModes &modes, const meshes::TriangleMesh &rest,
              const meshes::Points &positions);
} // namespace homespun::verification
