// SPDX-License-Identifier: MIT
// Both sides of a bracket on a drawing whose phases have curved sides, by meshes of straight
// triangles. A parabola lies between its chord and its tangents at the ends, an inscribed and a
// circumscribed polygon:
//
//           . apex .            what is certain: either phase on its own side
//        .  _______  .          what is not: the triangle of chord and apex, which holds
//     .-'   parabola  '-.       the control point where the tangents meet
//    tail -- chord -- head
//
// That triangle becomes an element of its own. With a stiffness below both phases there the
// complementary energy is at least that of the drawing, with one above both the potential energy:
// C^H grows with c. No order of the phases is needed. Per edge of length h and curvature kappa its
// area is kappa h^3 / 8: the sides of the bracket draw together like h^2.
//
// On the rim of a hole nothing takes the place of the lower stiffness, so that holes are
// circumscribed for the lower side and inscribed for the upper one.
#pragma once

#include "homogenization/cell/torus_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// The least matrix of the form V max(1, l) V^T above A and B, and the largest V min(1, l) V^T
/// below them, with A = V V^T and B = V diag(l) V^T.
Eigen::Matrix3d above_both(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B);
Eigen::Matrix3d below_both(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B);

/// A mesh on which both sides can be computed.
struct DrawnMesh
{
  TorusMesh mesh;          ///< the given vertices first; straight edges
  std::vector<int> parent; ///< of each triangle, in the mesh it was made from
  /// Of each material [N/m]: those of the mesh it was made from, then those of the uncertain
  /// triangles.
  std::vector<Eigen::Matrix3d> lower, upper;
  int n_certain = 0;               ///< materials
  std::vector<char> is_void_below; ///< of each triangle: it may be a part of a hole
  std::vector<char> is_flat; ///< of each triangle: it lies between chord, its edge 0, and apex

  bool is_uncertain(const int triangle) const
  {
    return mesh.triangles[static_cast<std::size_t>(triangle)].material >= n_certain;
  }
};

/// Carves the uncertain triangles out of a mesh; without curved edges it stays as it is.
/// @throws BadInput where a curve leaves the triangle that it bulges into
DrawnMesh drawn(const TorusMesh &mesh, const std::vector<Eigen::Matrix3d> &stiffness_of_material);

/// The triangles that are kept, with their vertices and edges.
TorusMesh with_only(const TorusMesh &mesh, const std::vector<char> &is_kept);
} // namespace homespun::homogenization
