// SPDX-License-Identifier: MIT
// The complementary energy of a sheet in linear theory: the lower side of its elastic energy. With
// Airy's stress function,
//   sigma_11 = phi,22   sigma_22 = phi,11   sigma_12 = −phi,12,
// every self-equilibrated stress is made of a phi; phi once continuously differentiable (the
// Clough-Tocher triangle) makes one whose tractions agree across every edge. The traction on an
// edge is the derivative of (phi,2, −phi,1) along it: it vanishes on a free edge where phi is an
// affine function there. Clamped edges leave phi free.
#pragma once

#include "homogenization/bracket/airy_unknowns.h"
#include "homogenization/bracket/equilibrated_stress.h"
#include "meshes/plain/sheet.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::verification
{
/// Maximises  integral eps(a) : sigma − 1/2 integral sigma : C^-1 : sigma  over those stresses.
///
/// a is the affine displacement that has the prescribed values on the clamped edges; the first
/// integral is the work of the tractions there, integral (sigma n) . a, because sigma is in
/// equilibrium and free edges have no traction. By the principle of minimum complementary energy no
/// such stress gives more than the exact elastic energy J, whatever the mesh. With a displacement
/// u_h that has the prescribed values and its energy J_upper,
///   |u_h − u|^2 + |sigma_h − sigma|^2 = 2 (J_upper − J_lower)
/// in the energy norms |u|^2 = integral eps : C : eps, |sigma|^2 = integral sigma : C^-1 : sigma.
/// Source: W. Prager and J. L. Synge, Quart. Appl. Math. 5 (1947).
class EquilibratedSheet
{
public:
  /// Edges of the sheet that are not clamped are free, rims of holes too. On each chain of them phi
  /// is an affine function of three unknowns, on the first chain zero: an affine part of phi has no
  /// stress. Chains that meet in a vertex are one, because phi and its gradient are shared there.
  /// @param stiffness_of_phase (3,3) [N/m]
  /// @param load of a sheet
  /// @throws NotConverged where the matrix is singular: parts that hang together by vertices alone
  EquilibratedSheet(const meshes::Sheet &sheet,
                    const std::vector<Eigen::Matrix3d> &stiffness_of_phase, const Load &load,
                    double strain);

  /// Stress 11, 22, 12 [N/m], linear in each of the three pieces of a triangle.
  /// @param piece of the triangle: (vertex piece, vertex piece + 1, centroid)
  /// @param barycentric coordinates in that piece
  Eigen::Vector3d stress(int triangle, int piece, const Eigen::Vector3d &barycentric) const;

  double energy    = 0.; ///< J_lower [J]
  double round_off = 0.; ///< bound on the error of its evaluation [J]
  double work     = 0.; ///< of the tractions on the prescribed displacement [J]; at the maximum 2 J
  unsigned n_dofs = 0;

private:
  using LocalValues = Eigen::Matrix<double, 12, 1>;
  struct Edge
  {
    int tail, head; ///< vertices, tail < head
    int chain   = -1;
    int unknown = -1; ///< the derivative along normal() at its middle; -1 on chains
  };

  void find_edges(const Load &load);
  void number_unknowns();
  Eigen::Vector2d normal(const Edge &edge) const;
  Eigen::Vector2d at_vertex(int v) const
  {
    return sheet.mesh.vertices.row(v).transpose();
  }
  homogenization::AiryDof on_chain(int chain, const Eigen::Vector2d &point,
                                   const Eigen::RowVector3d &of_value_and_gradient) const;
  homogenization::AiryDofs dofs_of(int triangle) const;
  std::array<Eigen::Vector2d, 3> shape_of(int triangle) const;
  homogenization::CloughTocher element(int triangle) const;
  LocalValues local_values(int triangle, LocalValues &rounded) const;
  void assemble_and_solve();
  void evaluate();

  const meshes::Sheet &sheet;
  const Eigen::Vector3d affine; ///< eps(a): 11, 22, twice 12
  const homogenization::Compliances compliances;
  std::vector<Edge> edges;
  std::vector<std::array<int, 3>> edges_of_triangle; ///< edge k joins the corners k and k + 1
  std::vector<int> chain_of_vertex;                  ///< -1 on none
  std::vector<Eigen::Vector2d> origin_of_chain;
  std::vector<int> first_of_chain;  ///< unknown; -1 of the chain on which phi is zero
  std::vector<int> first_of_vertex; ///< value, d/dx, d/dy; -1 on chains
  Eigen::VectorXd unknowns;
};
} // namespace homespun::verification
