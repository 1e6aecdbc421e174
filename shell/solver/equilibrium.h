// SPDX-License-Identifier: MIT
// Static equilibrium of the coarse cloth under prescribed positions and loads: grad W = f at every
// vertex that is not held, with the energy of corotational_energy.h (and guarded_cubic.h where that
// is asked for) or yarn_energy.h, and its small-strain linear form.
#pragma once

#include "meshes/plain/triangle_mesh.h"
#include "shell/algebra/free_vertex_matrix.h"
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

template <int dim>
struct Equilibrium
{
  Positions<dim> positions;             ///< (n,dim) [m]
  int iterations  = 0;                  ///< Newton steps taken
  double energy   = 0.;                 ///< of the membrane, without that of the loads [J]
  double residual = 0.;                 ///< norm of the forces on the free vertices [N]
  std::vector<double> residual_history; ///< before each step and at the end [N]
  int projected_steps =
    0; ///< steps that needed the projected Hessian: the cloth was near an instability
  int inverted_triangles = 0; ///< dim = 2: triangles with det F <= 0 at the end
};

/// Keeps the rest state, the sparsity and the symbolic factorisation of one cloth with one set of
/// held vertices. Solves reuse its work space: one solver belongs to one thread at a time.
/// @tparam Sheet Membrane, or another with the functions of membrane.h, its nodes at rest in
///   `vertices` and the elements of the matrix in `triangles`
template <int dim, typename Sheet = Membrane>
class MembraneSolver
{
public:
  /// Prepares the rest state and factors symbolically.
  /// @param rest mesh at rest, rest.material being the phase of each triangle
  /// @param stiffness_of_phase symmetric positive definite [N/m]
  /// @param held_vertices whose positions are prescribed, in any order
  /// @param cubic energies of third order, one per phase (add_cubic_energy()); none: e·D·e alone
  /// @throws BadInput as membrane() does, and where no vertex is held, a held vertex does not
  ///   exist, or a vertex hangs on no held one
  MembraneSolver(const meshes::TriangleMesh &rest, std::vector<Eigen::Matrix3d> stiffness_of_phase,
                 const std::vector<int> &held_vertices,
                 const std::vector<meshes::CubicForm> &cubic = {});

  /// The same of a sheet that is ready, whatever its law.
  /// @param membrane of a flat sheet: its vertices are there
  MembraneSolver(Sheet membrane, const std::vector<int> &held_vertices);

  /// Small-strain equilibrium, K u = f at the free vertices with K the Hessian at rest; factored on
  /// first use, then a substitution per call.
  /// @param prescribed (n,2) current positions of the held vertices [m]; other rows are ignored
  /// @param loads f (n,2) on the vertices, those on held ones are ignored; empty: none [N]
  /// @return (n,2) current positions X + u [m]
  /// @throws BadInput where a prescribed position or a load is not finite or the held vertices
  /// leave
  ///   a rigid motion free
  Positions<dim> solve_linear(const Positions<dim> &prescribed,
                              const Positions<dim> &loads = {}) const
  {
    static_assert(dim == 2, "a flat sheet at rest has no stiffness out of its plane: the linear "
                            "problem exists in the plane only");
    return linear_equilibrium(prescribed, loads);
  }

  /// Equilibrium at finite strain by Newton's method with a line search on the energy. A step uses
  /// the exact Hessian where it is positive definite, else the projected one (with the smallest
  /// shift that makes it so).
  /// @param start (n,dim) [m] first guess; its held rows are the prescribed positions
  /// @param loads f (n,dim) on the vertices, which do not turn with the cloth; those on held ones
  ///   are ignored; empty: none [N]
  /// @return positions of a stationary point at or below the energy of the start, that of the loads
  ///   included
  /// @throws BadInput where start or loads are not finite; NotConverged with the residual history
  Equilibrium<dim> solve_equilibrium(const Positions<dim> &start,
                                     const EquilibriumOptions &options = {},
                                     const Positions<dim> &loads       = {}) const;

  /// The membrane at rest, for its energy, gradient and Hessian.
  const Sheet &rest_membrane() const;

  /// Free vertices' matrix with the exact Hessian at the given positions, factored: one assembly
  /// and one numeric factorisation of a Newton step, for benchmarks. @return whether it is positive
  /// definite
  bool factorize_at(const Positions<dim> &positions) const;

private:
  Positions<dim> linear_equilibrium(const Positions<dim> &prescribed,
                                    const Positions<dim> &loads) const;
  Positions<dim> newton_step(const Positions<dim> &positions, const Positions<dim> &gradient,
                             int &projected_steps) const;

  Sheet membrane;
  std::vector<bool> is_held;
  mutable FreeVertexMatrix<dim> matrix;                         ///< of the Newton step
  mutable std::unique_ptr<FreeVertexMatrix<dim>> linear_matrix; ///< K, factored; made on first use
};
} // namespace homespun::shell
