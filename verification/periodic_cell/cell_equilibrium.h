// SPDX-License-Identifier: MIT
// Equilibria of one cell of an infinite cloth, at a macroscopic gradient F that is given, or that
// dead loads find: nominal stresses t_i along directions G_i of F.
//
//   find periodic w and q that make  1/|Y| integral W(F + sum q_i G_i + grad w) − sum t_i q_i
//   stationary; then t_i = P : G_i, P the mean nominal stress (Hill-Mandel).
#pragma once

#include "verification/periodic_cell/cell_assembly.h"

#include <Eigen/Core>

namespace homespun::verification
{
/// Directions of F that are free, a column each in the order F11, F12, F21, F22, and the nominal
/// stress along each [N/m].
struct DeadLoads
{
  Eigen::Matrix<double, 4, Eigen::Dynamic> directions = Eigen::Matrix<double, 4, 0>();
  Eigen::VectorXd stresses                            = Eigen::VectorXd(0);
};

/// A state of the cell; where it is searched from, and what is found.
struct CellEquilibrium
{
  Eigen::Matrix2d gradient;                         ///< F
  meshes::Points fluctuation;                       ///< w (n,2), zero at the anchor [m]
  double energy          = 0.;                      ///< mean of W [N/m]
  Eigen::Vector4d stress = Eigen::Vector4d::Zero(); ///< P11, P12, P21, P22, mean [N/m]
};

/// The state without strain, energy and stress.
CellEquilibrium at_rest(const CellAssembly &assembly);

/// Newton's method with a line search on the potential, from `state`; down to round-off, because
/// what is asked of a cell is often a small difference.
/// @throws NotConverged with the residual history
void find_equilibrium(const CellAssembly &assembly, const DeadLoads &loads, CellEquilibrium &state);

/// dP/dF of a state that was found, w in equilibrium and whatever holds F [N/m]:
/// K_FF − K_Fw K_ww^-1 K_wF. Not a number where K_ww is not positive definite: the fluctuation is
/// not stable.
Eigen::Matrix4d macro_tangent(const CellAssembly &assembly, const CellEquilibrium &state);
} // namespace homespun::verification
