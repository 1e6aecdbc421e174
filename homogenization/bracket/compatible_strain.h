// SPDX-License-Identifier: MIT
// The cell problems on a glued mesh by a direct solver: the upper side of a bracket on C^H. The
// same discrete problem as homogenize() solves in parallel, on meshes too deeply graded for its
// coordinates.
#pragma once

#include "homogenization/bracket/equilibrated_stress.h"
#include "homogenization/bracket/field_products.h"
#include "homogenization/bracket/holes.h"
#include "homogenization/cell/torus_mesh.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/SparseCore>

#include <optional>
#include <vector>

namespace homespun::homogenization
{
/// Minimises 1/|Y| integral (e − eps(chi)) : c : (e − eps(chi)) over periodic chi in P1 or P2 for
/// the three unit macro strains; chi is zero at the anchor.
///
/// On the rim of a rigid hole the total displacement e.y − chi is a rigid motion of three unknowns,
/// a + b (−y2, y1) (chi by itself being rigid there would be wrong: a hole does not stretch with
/// the cell); chi is then known up to a translation that nobody chose.
class CompatibleStrain
{
public:
  /// @param order 1 or 2
  /// @throws NotConverged where the matrix is singular; BadInput where rigid holes meet across the
  ///   outline
  CompatibleStrain(const TorusMesh &mesh, const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                   unsigned order, Holes holes = Holes::empty);

  /// e − eps(chi) at the field points of a triangle under the three unit macro strains.
  FieldOfLoads strain(int triangle) const;

  /// Of each material of the mesh, of the strains.
  std::vector<FieldProducts> products() const;

  /// Per triangle, h integral [t].(N1 + N2)^-1.[t] over its edges, half to each side: the jumps of
  /// the traction t = n.c:(e − eps(chi)), which an exact solution does not have, against the
  /// stiffness n.c.n of both sides. Only what is wrong nearby shows in them.
  /// @param weights of products of loads, sum over a, b of weights_ab t_a.t_b
  Eigen::VectorXd unbalanced_tractions(const Eigen::Matrix3d &weights) const;

  /// chi at the nodes (2 n,3) [m]: two rows per vertex of the mesh, then, in P2, two per edge.
  const Eigen::MatrixXd &chi_at_nodes() const
  {
    return unknowns;
  }

  /// chi at the vertices of the mesh that was glued, shape (n,6) [m].
  meshes::Chi chi_at_given_vertices() const;

  Eigen::Matrix3d stiffness;         ///< the energies [N/m]
  Eigen::Matrix3d stiffness_by_flux; ///< the mean stresses (Eq. 4) [N/m]
  double round_off;                  ///< bound on the error of its entries, by relative_error
  double excess;                     ///< of the energy above that of the exact minimiser, relative
  unsigned n_dofs;
  unsigned iterations;

private:
  template <int n_shapes>
  void assemble_and_solve();
  template <int n_shapes>
  FieldOfLoads strain_of(int triangle, FieldOfLoads *bar) const;
  template <int n_shapes>
  Eigen::VectorXd unbalanced_tractions_of(const Eigen::Matrix3d &weights) const;
  template <int n_shapes>
  Eigen::Matrix<double, 2 * n_shapes, 3> displacements_from_first_vertex(int triangle) const;
  void evaluate();
  void solve_with_rigid_holes(const Eigen::SparseMatrix<double> &matrix,
                              const Eigen::MatrixXd &loads);
  bool has_rigid_holes() const
  {
    return rims && rims->n_holes > 0;
  }
  int row_or_pinned(int unknown) const;
  template <int n_shapes>
  Eigen::Matrix<double, 2 * n_shapes, 3> roundings_of(int triangle) const;
  int first_unknown(int triangle, int shape) const;

  const TorusMesh &mesh;
  const std::vector<Eigen::Matrix3d> stiffnesses;
  const unsigned order;
  const std::optional<Rims> rims; ///< of rigid holes
  Eigen::MatrixXd unknowns;       ///< two per vertex, then two per edge
  Eigen::MatrixXd roundings;      ///< how wrong the unknowns on rigid rims may be; else empty
};
} // namespace homespun::homogenization
