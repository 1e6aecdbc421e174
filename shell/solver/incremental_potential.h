// SPDX-License-Identifier: MIT
// What a time step of a cloth minimises, and the matrix in which its Hessian is assembled and
// solved:
//   Φ(x) = Σ m s/2 |x − x̂|² + Σ_terms E(x),   x̂ = x_n + h v_n,   s = 1/h²;
// with s = 0 the sum of the terms alone, whose minimum is an equilibrium. Held vertices are no
// unknowns.
#pragma once

#include "shell/algebra/block_cholesky.h"
#include "shell/terms/term.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

namespace homespun::shell
{
/// Systems are factored: conjugate gradients with incomplete Cholesky took 2.6, 4 and 7 times as
/// long at 441, 2,601 and 25,281 vertices. With 145,161 a factor takes 2.6 s and 0.7 GB.
struct SolverOptions
{
  double newton_tolerance = 1e-8; ///< |gradient of Φ| over the size of the forces it is made of [-]
  int max_newton_iterations = 40;
};

/// What solving took.
struct SolveCounts
{
  int newton_iterations = 0; ///< factorisations
  int unconverged =
    0; ///< minimisations that ended before the tolerance, with no more energy than before
};

class IncrementalPotential
{
public:
  /// @param masses (n) [kg]
  /// @param is_held (n) vertices that are no unknowns
  IncrementalPotential(const Eigen::VectorXd &masses, std::vector<bool> is_held,
                       const SolverOptions &options);

  /// Adds a term. The matrix is laid out anew by the next prepare().
  void add(std::unique_ptr<Term> term);

  /// Lays out the matrix, its solver, and the terms' places in it, where that has not been done.
  void prepare();

  const std::vector<std::unique_ptr<Term>> &terms() const
  {
    return all_terms;
  }

  /// Whether every term is the gradient of an energy, so that Φ can be minimised.
  bool has_energy() const;

  /// Φ [J].
  /// @param inertial x̂ (n,3) [m]
  /// @param inverse_square s [1/s²]
  double value(const Vectors &positions, const Vectors &inertial, double inverse_square) const;

  /// Sum of the terms' stored energies [J].
  double stored_energy(const Vectors &positions) const;

  /// Norms over the free vertices: of the gradient, of the forces before they cancel, and of what
  /// one rounding of the positions changes [N].
  struct Residual
  {
    double norm = 0., size = 0., round_off = 0.;
    bool is_below(const double tolerance) const
    {
      return norm <= tolerance * size + round_off;
    }
  };

  /// Assembles gradient (in gradient(), zero at held vertices) and Hessian of Φ.
  Residual assemble(const Vectors &positions, const Vectors &inertial, double inverse_square,
                    Hessian kind);

  /// What rounding does to a value of Φ [J]: what it changes by when every position moves by one
  /// rounding, which counts where its terms cancel, and the round-off of its sum and of its terms.
  double round_off_of(double value, const Vectors &positions, const Residual &residual) const;

  /// dΦ/dx of the last assemble() (n,3) [N].
  const Vectors &gradient() const
  {
    return assembled_gradient;
  }

  /// Solves with the matrix as it is assembled.
  /// @param result (n,3) [m]
  /// @return false where the matrix is not positive definite
  bool solve(const Vectors &right_side, Vectors &result, SolveCounts &counts);

  /// One Newton step of Φ from x_n with the projected Hessian, the held vertices going where they
  /// are told: where linearly implicit Euler ends.
  /// @param positions x_n (n,3) [m]
  /// @param velocities v_n (n,3) [m/s]
  /// @param held_displacement (n,3), its rows of held vertices are what they move by [m]
  /// @return x_{n+1} − x_n, zero at held vertices [m]
  /// @throws NotConverged where the matrix is not positive definite
  Vectors linear_step(const Vectors &positions, const Vectors &velocities,
                      const Vectors &held_displacement, double h, SolveCounts &counts);

  /// Newton's method with line search on Φ. An iteration uses the exact Hessian where it is
  /// positive definite, else the projected one; after such a one the next does without the attempt,
  /// unless the step was a full one.
  /// @param positions start and result, whose held rows are prescribed
  /// @param is_enough whether positions short of the minimum will do where the line search or the
  ///   iterations end, at a kink of the energy or at round-off; it is counted
  /// @throws NotConverged with the residual history
  void minimize(const Vectors &inertial, double h,
                const std::function<bool(const Vectors &)> &is_enough, Vectors &positions,
                SolveCounts &counts);

  /// Trace of the assembled diagonal block, 0 at a held vertex [N/m].
  double stiffness_at(int vertex) const;

  /// Bytes of terms, matrix and factors.
  std::size_t bytes() const;

private:
  Vectors with_nodes(const Vectors &right_side) const;

  const Eigen::VectorXd m;
  const std::vector<bool> is_held;
  const SolverOptions options;
  std::vector<std::unique_ptr<Term>> all_terms;
  std::unique_ptr<BlockMatrix> matrix;
  std::unique_ptr<BlockCholesky> cholesky;
  std::vector<BlockMatrix::Slot> diagonal;
  Vectors assembled_gradient;
};
} // namespace homespun::shell
