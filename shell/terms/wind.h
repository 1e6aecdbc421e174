// SPDX-License-Identifier: MIT
// What air does to a cloth: pressure on one side, and the drag of moving against it.
//
// Drag, per corner of a triangle with a third of its area A, from the velocity u relative to the
// air:
//   F = −½ rho A/3 (Cn |u_n| u_n + Ct |u_t| u_t),   u_n = (n·u) n,  u_t = u − u_n.
// The first part is the pressure on a plate, quadratic in the normal speed (Newton's sine-square
// law); across the wind it is the lift of an inclined triangle. The second is friction along it.
// begin_step() freezes the speeds |u|, normals and areas at x_n; the rest is linear in the velocity
// at the end of the step: E = ½ h (u·B u) with B >= 0 and block diagonal, so that no wind and no
// step can make it unstable, and a steady state, where speeds no longer change, has the full
// quadratic drag.
//
// A triangle collapsed to a line or a point has no normal and feels nothing. Neither term is an
// energy of the cloth.
//
// Limits. Air of given velocity, not moved by the cloth: no wake, no shelter behind other parts,
// and none of the circulation that makes the lift of a wing at small angles.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/terms/term.h"

#include <functional>
#include <memory>

namespace homespun::shell
{
struct Air
{
  double density         = 1.2;  ///< [kg/m^3]
  double normal_drag     = 1.28; ///< Cn, that of a plate across the wind [-]
  double tangential_drag = 0.;   ///< Ct [-]
  /// Velocity [m/s] at a point [m] and a time [s]; none: still air.
  std::function<Eigen::Vector3d(const Eigen::Vector3d &point, double time)> velocity;
};

/// Drag and lift against the air, on the current areas.
/// @throws BadInput for a density or coefficients that are negative or not finite
std::unique_ptr<Term> wind_term(const meshes::ClothMesh &mesh, const Air &air);

/// Pressure on the side that the normals leave from (counter-clockwise triangles seen from where
/// they point): p A n/3 on each corner. The load follows the cloth from step to step; within a step
/// it is that at x_n, because on an open cloth it has no energy. An equilibrium needs begin_step()
/// again until the load no longer turns.
/// @param pressure [Pa] at a time [s]; negative: suction
std::unique_ptr<Term> pressure_term(const meshes::ClothMesh &mesh,
                                    std::function<double(double time)> pressure);
} // namespace homespun::shell
