// SPDX-License-Identifier: MIT
// What the held places of a scene exert on a cloth: its pins and handles.
#pragma once

#include "verification/drape/drape_tables.h"
#include "verification/drape/held_motion.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// The force of one held place.
struct HeldForce
{
  std::string place;                                     ///< as the scene calls it
  Eigen::RowVector3d force = Eigen::RowVector3d::Zero(); ///< [N]
};

/// A cloth at the end of a step.
struct HeldCloth
{
  const meshes::ClothMesh &mesh;       ///< where it begins
  const Eigen::VectorXd &masses;       ///< (n) [kg]
  const meshes::SpacePoints &gradient; ///< (n,3) dE/dx of all that acts but inertia [N]
  double time = 0.;                    ///< [s]
  double step = 0.;                    ///< h [s]; infinity of an equilibrium
};

/// Of each place the sum of dE/dx_v + m_v a_v over the vertices that it holds, with
///   a = (x(t) − 2 x(t − h) + x(t − 2h)) / h²,
/// what implicit Euler takes for their acceleration. All places together carry the cloth: their sum
/// is the rate of its momentum less what acts from outside, to the residual of the step. With the
/// conserving integrator, which balances forces within a step, it is so to first order in h.
std::vector<HeldForce> held_forces(const HeldMotion &motion, const HeldCloth &cloth);
} // namespace homespun::verification
