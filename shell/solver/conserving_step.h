// SPDX-License-Identifier: MIT
// A step that keeps both momenta and the energy by construction. With v_{n+1} = 2 (x_{n+1} − x_n)/h
// − v_n,
//   2 m/h² (x_{n+1} − x_n − h v_n) + g(x_n, x_{n+1}) = 0,
// where g is the sum of the terms' discrete gradients (term.h): its work over the step is the
// change of their energy, it has no sum and no torque about the mean positions. Times 1, x̄ and
// x_{n+1} − x_n the equation says that linear momentum, angular momentum and kinetic plus stored
// energy are what they were, less what a dissipation takes. It is of second order; in a relative
// equilibrium (a shape that only turns, with the angular velocity ω) it turns the very same shape
// by 2 atan(h ω/2) (Gonzalez and Simo, "On the stability of symplectic and energy-momentum
// algorithms for nonlinear Hamiltonian systems with symmetry", CMAME 134, 1996).
//
// What is kept is kept to the residual that Newton's method leaves: nothing is put right
// afterwards. The matrix is not symmetric, and a step has no minimum to search for: line search is
// on the residual, and a step in which it ends is cut. Waves that the step does not resolve are
// neither damped nor followed: only a viscosity takes them away.
#pragma once

#include "shell/algebra/vertex_matrix.h"
#include "shell/solver/incremental_potential.h"

#include <memory>
#include <vector>

namespace homespun::shell
{
class ConservingStep
{
public:
  /// @param masses (n) [kg]
  /// @param is_held (n) vertices that are no unknowns
  ConservingStep(const Eigen::VectorXd &masses, const std::vector<bool> &is_held,
                 const SolverOptions &options);

  /// Newton's method; after the tolerance is met once more, because it ends quadratically.
  /// @param terms with discrete gradients, at the beginning of the step
  /// @param old,velocities (n,3) at the beginning [m], [m/s]
  /// @param positions start and result, whose held rows are prescribed
  /// @throws NotConverged with the residual history
  void solve(const std::vector<std::unique_ptr<Term>> &terms, const Vectors &old,
             const Vectors &velocities, double h, Vectors &positions, SolveCounts &counts);

  std::size_t bytes() const
  {
    return matrix.bytes();
  }

private:
  struct Balance
  {
    Vectors residual; ///< zero at held vertices [N]
    double norm = 0., size = 0., round_off = 0.;
  };
  Balance balance(const std::vector<std::unique_ptr<Term>> &terms, const Vectors &old,
                  const Vectors &velocities, double h, const Vectors &positions);

  const Eigen::VectorXd masses;
  const std::vector<bool> is_held;
  const SolverOptions options;
  VertexMatrix matrix;
};
} // namespace homespun::shell
