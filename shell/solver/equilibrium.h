// SPDX-License-Identifier: MIT
// Static equilibrium of a sheet in its plane under prescribed positions and loads: grad W = f at
// every vertex that is not held, with the energy of corotational_energy.h (and guarded_cubic.h
// where that is asked for) or yarn_energy.h, and its small-strain linear form. In space a cloth is
// a Cloth (cloth.h).
#pragma once

#include "shell/algebra/plane_matrix.h"
#include "shell/membrane/membrane.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace homespun::shell
{
struct EquilibriumOptions
{
  /// Norm of the free vertices' forces over that of the sums of absolute element forces [-]. Forces
  /// below what one rounding of the positions changes them by count as zero.
  double relative_tolerance = 1e-10;
  int max_iterations        = 50;
};

struct Equilibrium
{
  Positions<2> positions;               ///< (n,2) [m]
  int iterations  = 0;                  ///< Newton steps taken
  double energy   = 0.;                 ///< of the membrane, without that of the loads [J]
  double residual = 0.;                 ///< norm of the forces on the free vertices [N]
  std::vector<double> residual_history; ///< before each step and at the end [N]
  int projected_steps =
    0; ///< steps that needed the projected Hessian: the cloth was near an instability
  int inverted_triangles = 0; ///< with det F <= 0 at the end
};

/// Keeps the rest state, the sparsity and the symbolic factorisation of one cloth with one set of
/// held vertices. Solves reuse its work space: one solver belongs to one thread at a time.
/// @tparam Sheet Membrane, or another with the functions of membrane.h, its nodes at rest in
///   `vertices` and the elements of the matrix in `triangles`
template <typename Sheet = Membrane>
class MembraneSolver
{
public:
  /// Factors symbolically.
  /// @param membrane of a flat sheet, whatever its law: its vertices are there
  /// @param held_vertices whose positions are prescribed, in any order
  /// @throws BadInput where no vertex is held, a held vertex does not exist, or a vertex hangs on
  /// no
  ///   held one
  MembraneSolver(Sheet membrane, const std::vector<int> &held_vertices);

  /// Small-strain equilibrium, K u = f at the free vertices with K the Hessian at rest; factored on
  /// first use, then a substitution per call.
  /// @param prescribed (n,2) current positions of the held vertices [m]; other rows are ignored
  /// @param loads f (n,2) on the vertices, those on held ones are ignored; empty: none [N]
  /// @return (n,2) current positions X + u [m]
  /// @throws BadInput where a prescribed position or a load is not finite or the held vertices
  ///   leave a rigid motion free
  Positions<2> solve_linear(const Positions<2> &prescribed, const Positions<2> &loads = {}) const;

  /// Equilibrium at finite strain by Newton's method with a line search on the energy. A step uses
  /// the exact Hessian where it is positive definite, else the projected one (with the smallest
  /// shift that makes it so).
  /// @param start (n,2) [m] first guess; its held rows are the prescribed positions
  /// @param loads f (n,2) on the vertices, which do not turn with the cloth; those on held ones
  ///   are ignored; empty: none [N]
  /// @return positions of a stationary point at or below the energy of the start, that of the loads
  ///   included
  /// @throws BadInput where start or loads are not finite; NotConverged with the residual history
  Equilibrium solve_equilibrium(const Positions<2> &start, const EquilibriumOptions &options = {},
                                const Positions<2> &loads = {}) const;

  /// The membrane at rest, for its energy, gradient and Hessian.
  const Sheet &rest_membrane() const
  {
    return membrane;
  }

  /// Free vertices' matrix with the exact Hessian at the given positions, factored: one assembly
  /// and one numeric factorisation of a Newton step, for benchmarks. @return whether it is positive
  /// definite
  bool factorize_at(const Positions<2> &positions) const;

private:
  Positions<2> newton_step(const Positions<2> &positions, const Positions<2> &gradient,
                           int &projected_steps) const;

  Sheet membrane;
  std::vector<bool> is_held;
  mutable PlaneMatrix matrix;                         ///< of the Newton step
  mutable std::unique_ptr<PlaneMatrix> linear_matrix; ///< K, factored; made on first use
};
} // namespace homespun::shell
