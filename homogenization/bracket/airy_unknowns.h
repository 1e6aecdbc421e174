// SPDX-License-Identifier: MIT
// The unknowns of a periodic stress function on Clough-Tocher triangles, with empty holes on whose
// rims it is known up to an affine function, or rigid ones on whose rims it is free: which of them
// each triangle's twelve degrees of freedom are made of.
#pragma once

#include "homogenization/bracket/holes.h"
#include "homogenization/cell/torus_mesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::homogenization
{
/// A degree of freedom of a triangle, in terms of the unknowns: sum of factor x unknown + known.
struct AiryDof
{
  std::array<int, 3> unknowns   = {-1, -1, -1}; ///< -1 where there is none
  std::array<double, 3> factors = {0., 0., 0.};
  Eigen::RowVector3d known      = Eigen::RowVector3d::Zero(); ///< per load
};

/// Value, d/dx, d/dy at the three corners, then the derivative along edge_normal() in the middle of
/// each edge.
using AiryDofs = std::array<AiryDof, 12>;

/// The derivative of phi along the normal of an edge: quadratic along it, with an unknown in its
/// middle, or linear, the mean of its two ends there: the reduced Clough-Tocher triangle (Ciarlet,
/// The Finite Element Method for Elliptic Problems, 1978, 6.1), which has half as many unknowns.
/// Its stresses converge as the strains of linear displacements do.
enum class NormalDerivatives
{
  quadratic,
  linear
};

/// The unit normal of an edge that belongs to its degree of freedom.
Eigen::Vector2d edge_normal(const TorusEdge &edge);

/// Numbers phi of the three unit mean stresses: value and gradient at each vertex, normal
/// derivative at each edge where that is quadratic; on the rim of an empty hole phi is minus the
/// mean stress's own stress function plus an affine function of three unknowns.
class AiryUnknowns
{
public:
  /// @throws BadInput where empty holes meet across the outline
  explicit AiryUnknowns(const TorusMesh &mesh, Holes holes = Holes::empty,
                        NormalDerivatives normal_derivatives = NormalDerivatives::quadratic);

  /// Normal derivatives that are linear have no unknown; they follow from the gradients at the
  /// corners.
  AiryDofs of_triangle(int t) const;

  /// phi at a vertex of the mesh that was glued.
  AiryDof value_at(int vertex) const;

  int number = 0;  ///< of unknowns, the pinned one among them
  int pinned = -1; ///< the value that takes out the constant

private:
  void number_unknowns();
  /// phi on the rim of a hole, of which the row takes a combination of value, d/dx and d/dy.
  AiryDof on_rim(const RimPoint &rim, const Eigen::RowVector3d &of_value_and_gradient) const;

  const TorusMesh &mesh;
  const NormalDerivatives normal_derivatives;
  std::vector<int> first_unknown;   ///< of each vertex: value, d/dx, d/dy; -1 on rims
  std::vector<int> unknown_of_edge; ///< -1 on rims
  std::vector<int> centre_of;       ///< see number_unknowns(); -1 for most vertices
  Rims rims;                        ///< of empty holes
  std::vector<int> first_unknown_of_hole;
};
} // namespace homespun::homogenization
