// SPDX-License-Identifier: MIT
// A moving cloth: masses, held vertices, and the terms that a scene adds (term.h). What is absent
// is never called.
//
// Three integrators take a step of h:
// linearly implicit (Baraff & Witkin 1998): one Newton step of the incremental potential Φ of
//   implicit Euler (incremental_potential.h) with the positive semi-definite Hessian, one assembly
//   and one factorisation, of a free cloth from where a rigid body with its momenta would be.
//   Should it raise the energy of a cloth on which nothing does work, or otherwise Φ, Newton's
//   method goes on with a line search.
// implicit: the minimum of Φ to a tolerance, by Newton's method with line search; the exact Hessian
//   where it is positive definite, else the projected one.
// conserving: discrete gradients (conserving_step.h); it takes membrane, viscosity, bending,
// gravity and damping. A step that fails is cut in two, up to a number of times, and repeated; a
// state that is not finite stops the run. Nothing is put right after a solve: velocities are
// (x_{n+1} − x_n)/h, of the conserving integrator twice that less the old ones.
//
// What theory gives. Both Euler methods are of first order. They keep the linear momentum; of the
// angular one implicit Euler loses h Σ m v_n × v_{n+1} in a step, so that a rigid body turns by
// atan(h ω) instead of h ω and keeps the share cos(atan(h ω)) of its angular momentum. Its energy
// changes by −½ Σ m |v_{n+1} − v_n|² plus what E(x_{n+1}) exceeds its tangent at x_{n+1} by, taken
// back to x_n: it falls where the energy is convex along the step, and stored energy and ½ Σ m
// |v_{n+1} − v_n|² never exceed what there was. The conserving integrator is of second order and
// keeps both momenta and the energy, of which a dissipation takes its part, to the tolerance of its
// solve.
#pragma once

#include "shell/solver/conserving_step.h"
#include "shell/solver/incremental_potential.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace homespun::shell
{
enum class Integrator
{
  linearly_implicit,
  implicit,
  conserving
};

struct ClothOptions : SolverOptions
{
  Integrator integrator = Integrator::linearly_implicit;
  int max_cuts          = 8; ///< halvings of a step that fails
};

/// What a step took, and what theory says that it may change.
struct StepReport : SolveCounts
{
  int cuts    = 0; ///< halvings of the step
  int guarded = 0; ///< linearly implicit steps that went on with a line search
  /// By how much the energy of a closed cloth grew, summed over the parts of the step [J].
  double energy_gained = 0.;
  /// Sum over the parts of the step of |change of angular momentum| of a cloth on which nothing
  /// acts from outside: the error of first order of both Euler methods, of the conserving one what
  /// its solve leaves [kg m²/s].
  double spin_lost = 0.;
};

/// What an equilibrium took.
struct ClothEquilibrium
{
  int iterations  = 0;
  double residual = 0.;                 ///< |gradient| over the free vertices [N]
  std::vector<double> residual_history; ///< before each iteration and at the end [N]
};

class Cloth
{
public:
  /// @param positions (n,3) at the beginning, velocities are zero [m]
  /// @param masses (n) [kg]
  /// @param held_vertices those that are moved by prescribe() or stay
  /// @throws BadInput where sizes do not match, a number is not finite, a mass not positive, a held
  ///   vertex does not exist
  Cloth(const Vectors &positions, const Eigen::VectorXd &masses,
        const std::vector<int> &held_vertices, const ClothOptions &options = {});

  /// Adds a term. The matrix is laid out anew at the next step.
  void add(std::unique_ptr<Term> term);

  /// Where a held vertex is to be at the end of the next step [m]. Stays so until told otherwise.
  void prescribe(int vertex, const Eigen::RowVector3d &position);

  /// One time step.
  /// @param h > 0 [s]
  /// @throws BadInput for another h, and where the energy is infinite and no force leads out of it
  ///   (of a conserving step: where it is infinite); NotConverged where cutting does not help, with
  ///   the step, the vertex and what to try. The state is then that before the step.
  StepReport step(double h);

  /// Static equilibrium of the stored energy under the prescribed positions: pseudo-transient
  /// continuation (implicit Euler steps without memory of the velocity, whose length grows as the
  /// residual falls: Kelley & Keyes 1998), then Newton's method with the exact Hessian. Velocities
  /// become zero.
  /// @param relative_tolerance of |gradient| over the sum of the absolute forces at the vertices
  ///   [-]
  /// @throws NotConverged with the residual history
  ClothEquilibrium solve_equilibrium(double relative_tolerance = 1e-8, int max_iterations = 400);

  const Vectors &positions() const
  {
    return x;
  }
  const Vectors &velocities() const
  {
    return v;
  }
  /// @throws BadInput where not finite or of another size
  void set_state(const Vectors &positions, const Vectors &velocities, double time);

  double time() const
  {
    return now;
  }
  double kinetic_energy() const;
  /// Sum of the terms' stored energies [J].
  double stored_energy() const;
  Eigen::RowVector3d momentum() const;
  /// About the centre of mass [kg m^2/s].
  Eigen::RowVector3d angular_momentum() const;
  /// Sum of all terms' gradients (n,3) [N]; the forces are its negative.
  Vectors gradient() const;

  const std::vector<std::unique_ptr<Term>> &terms() const
  {
    return potential.terms();
  }
  const Eigen::VectorXd &masses() const
  {
    return m;
  }
  /// Bytes of terms, matrix and factors.
  std::size_t bytes() const;

private:
  void set_held(Vectors &positions) const;
  std::optional<Eigen::RowVector3d> closed_frame(double h) const;
  bool is_moved_by(const Eigen::RowVector3d &way) const;
  double kinetic_energy_in(const Eigen::RowVector3d &frame, const Vectors &velocities) const;
  bool is_alone() const;
  void try_step(double h, StepReport &report);
  Vectors linear_step(const Vectors &inertial, double h, StepReport &report);
  bool is_overshot(const Vectors &next, const Vectors &inertial, double h) const;
  Vectors start_of_solve(double h) const;
  Vectors minimum(const Vectors &inertial, double h, StepReport &report);
  Vectors conserved(double h, StepReport &report);
  void check_finite(const Vectors &positions, double h) const;
  std::string why_infinite(const Vectors &positions) const;
  void check_start() const;

  Vectors x, v, target;
  const Eigen::VectorXd m;
  const std::vector<int> held;
  const ClothOptions options;
  IncrementalPotential potential;
  std::unique_ptr<ConservingStep> conserving; ///< once asked for
  double now  = 0.;
  long n_step = 0;
  mutable std::optional<double> stored; ///< energy of x, where known
};
} // namespace homespun::shell
