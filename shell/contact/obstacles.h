// SPDX-License-Identifier: MIT
// Bodies that a cloth cannot enter: planes, spheres, closed meshes, at rest or moved, with Coulomb
// friction. A penalty per vertex, so that the Hessian is block diagonal, on the distance to a
// half-space that is chosen once per step: E = ½ k (n·x − b)² is quadratic and positive
// semi-definite.
//
// Linearly implicit Euler linearises at x_n and would not see what lies within the step. So
// begin_step() looks ahead and freezes half-spaces, in the frame of the body at the end of the
// step:
//  - a vertex touches (it is within the thickness) and x_n + h v_n + h² g would not leave: that of
//    its nearest point; where it then slides into another face, that of the face too;
//  - x_n + h v_n would go through the surface or end within the thickness: that of the point of
//    entry or of the nearest point. A body thinner than the way of one step stops a vertex all the
//    same;
//  - only with h² g it would, and v_n does not lead away: the same half-space, but with a spring of
//    m/h² that just catches the vertex in free fall. A cloth that hangs beside the body feels at
//    most some m g.
// These act in both directions for this step, so that a vertex on its way lands on them; a vertex
// that would leave is let go, and one that something pulls away is pulled back for one step at
// most. Other vertices nearby have a one-sided half-space, for solvers that iterate, as all have in
// an equilibrium.
//
// Friction is lagged: normal force and tangent plane are those at x_n. With slip speed s its force
// is mu λ f(s), f(s) = s/e (2 − s/e) below a small speed e and 1 above (Li et al., "Incremental
// potential contact", SIGGRAPH 2020), in secant form with f(s)/s frozen: ½ c |tangential
// way|², positive semi-definite, never reverses a motion. A vertex that sticks creeps by less than
// e. One that slides changes its speed by s/(s + mu λ h/m) of what it should, the whole once it is
// faster than gravity makes it in a step.
//
// Limits. Vertices only: a corner of a body can poke through a triangle. A vertex that turns round
// within one step, at the top of a bounce lower than h² g, dips into the body by up to h² g for one
// step. What other forces than gravity push into a body within a step is seen one step late. A
// vertex on its way to the body lands on it even if something would have stopped it within the
// step. A load of N vertex masses upon one vertex rests N g h²/1000 deep with the default
// stiffness. Not an energy that is conserved: half-spaces change.
#pragma once

#include "shell/contact/shapes.h"
#include "shell/terms/term.h"

#include <functional>
#include <memory>
#include <string>

namespace homespun::shell
{
struct Obstacle
{
  std::string name;                   ///< as a scene file calls it
  std::shared_ptr<const Shape> shape; ///< where the body is before it moves
  double friction = 0.;               ///< Coulomb's coefficient mu [-]
  /// How far the body has moved [m] at a time [s]; none: it rests.
  std::function<Eigen::Vector3d(double time)> displacement;
};

struct ContactParameters
{
  double thickness = 1e-3; ///< distance at which contact begins [m]
  double stiffness =
    0.; ///< per vertex [N/m]; 0: 1000 m/h², which an equilibrium (h infinite) cannot take
  double slip_speed = 1e-3; ///< below it, friction sticks [m/s]
  /// At which a vertex within the thickness is pushed out at most [m/s]; where there is gravity, no
  /// faster than a fall through the same way.
  double recovery_speed = 1.;
  Eigen::Vector3d gravity =
    Eigen::Vector3d::Zero(); ///< that the scene has, for looking ahead [m/s²]
};

/// The contact of all vertices with one body, but for those that are held.
/// @param masses (n) per vertex [kg], positive
/// @throws BadInput with all faults of the parameters; begin_step() throws it where a stiffness is
///   needed
std::unique_ptr<Term> obstacle_term(const Obstacle &obstacle, const Eigen::VectorXd &masses,
                                    const ContactParameters &parameters);
} // namespace homespun::shell
