// SPDX-License-Identifier: MIT
// The complementary energy of a unit cell: the lower side of a bracket on C^H. Every periodic
// stress in equilibrium with the mean stress Sigma is Sigma + curl curl phi, i.e.
//   sigma_11 = Sigma_11 + phi,22   sigma_22 = Sigma_22 + phi,11   sigma_12 = Sigma_12 − phi,12
// with periodic phi, once continuously differentiable. The Clough-Tocher triangle makes such phi;
// whichever it is, its energy bounds the compliance from above, and C^H thereby from below.
#pragma once

#include "homogenization/bracket/airy_unknowns.h"
#include "homogenization/bracket/clough_tocher.h"
#include "homogenization/cell/torus_mesh.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace homespun::homogenization
{
/// Points per triangle at which fields are compared: the middles of the sides of its three pieces,
/// weight area / 9 each. Products of fields that are linear in each piece are integrated exactly.
constexpr int n_field_points = 9;
/// Three loads, one per column; at point q the rows 3 q ... 3 q + 2 hold 11, 22, 12.
using FieldOfLoads = Eigen::Matrix<double, 3 * n_field_points, 3>;

const std::array<PiecePoint, n_field_points> &field_points();

/// Second derivatives of the shape functions at the field points, rows 11, 22, 12 each.
std::array<Eigen::Matrix<double, 3, 12>, n_field_points>
second_derivatives_at_field_points(const CloughTocher &element);

/// The stresses of the shape functions of an Airy function at a point of a piece, rows 11, 22, 12.
Eigen::Matrix<double, 3, 12> stress_of_airy(const CloughTocher &element, int piece,
                                            const Eigen::Vector3d &barycentric);

/// Signed area of a triangle.
double area_of(const std::array<Eigen::Vector2d, 3> &shape);

/// Inverses of stiffnesses, and what they miss by.
struct Compliances
{
  explicit Compliances(const std::vector<Eigen::Matrix3d> &stiffnesses);

  const Eigen::Matrix3d &operator[](const std::size_t material) const
  {
    return inverses[material];
  }

  std::vector<Eigen::Matrix3d> inverses;
  double error = 0.; ///< largest row sum of |c s − 1|
};

/// Minimises 1/|Y| integral sigma : c^-1 : sigma for the three unit mean stresses.
///
/// Holes are exact: on the rim of an empty hole phi is −Sigma's own stress function plus an affine
/// function of three unknowns, so that the stress vanishes in the hole and its traction on the rim.
/// On the rim of a rigid one phi is free: the hole may hold any stress.
class EquilibratedStress
{
public:
  /// @param stiffness_of_material [N/m]
  /// @param normal_derivatives of phi: linear ones make half as many unknowns
  /// @param flat whether vertex 2 of a triangle lies close to its edge 0 (and to that of no other);
  ///   empty: none does, as it must be where normal derivatives are linear
  /// @throws BadInput where empty holes meet across the outline; NotConverged where the matrix is
  ///   singular
  EquilibratedStress(const TorusMesh &mesh,
                     const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                     std::vector<char> flat = {}, Holes holes = Holes::empty,
                     NormalDerivatives normal_derivatives = NormalDerivatives::quadratic);

  /// Stress at the field points of a triangle under the three unit mean stresses.
  FieldOfLoads stress(int triangle) const;

  /// Per triangle, h integral [eps_tt]^2 / (s1 + s2) over its edges, half to each side, and over
  /// the sides of its pieces: the jumps of the strain along the edge, eps = c^-1 : sigma, which an
  /// exact solution does not have, against the compliance s along the edge on both sides.
  /// @param weights of products of loads
  Eigen::VectorXd incompatible_strains(const Eigen::Matrix3d &weights) const;

  /// phi at the vertices of the mesh that was glued under the three unit mean stresses, shape (n,3)
  /// [stress times m^2]; zero at the anchor, or known up to an affine function of the rim where
  /// there are empty holes.
  Eigen::Matrix<double, Eigen::Dynamic, 3> stress_function_at_given_vertices() const;

  Eigen::Matrix3d compliance; ///< S_h = 1/|Y| integral sigma_a : c^-1 : sigma_b [m/N]
  double round_off;           ///< bound on the error of its entries, by relative_error
  double excess;              ///< of the energy above that of the exact minimiser, relative
  unsigned n_dofs;
  unsigned iterations;

private:
  using StressRows  = Eigen::Matrix<double, 3 * n_field_points, 12>;
  using LocalValues = Eigen::Matrix<double, 12, 3>;

  CloughTocher element(int triangle) const;
  StressRows stress_rows(int triangle) const;
  Eigen::RowVector2d half_normal(int triangle, int side) const;
  StressRows rows_of_unknowns(int triangle) const;
  LocalValues local_values(int triangle) const;
  void assemble_and_solve();
  bool is_flat(const int triangle) const
  {
    return !flat.empty() && flat[static_cast<std::size_t>(triangle)];
  }
  Eigen::Matrix<double, 5, 7> continued(int triangle) const;
  Eigen::SparseMatrix<double> basis_of_flat_triangles() const;
  void change_basis(int triangle, StressRows &B, AiryDofs &dofs) const;
  void evaluate();

  const TorusMesh &mesh;
  const Holes holes;
  const NormalDerivatives normal_derivatives;
  const AiryUnknowns numbering;
  const Compliances compliances; ///< of each material
  const std::vector<char> flat;
  Eigen::MatrixXd unknowns;
};
} // namespace homespun::homogenization
