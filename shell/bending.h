// SPDX-License-Identifier: MIT
// Bending of a cloth: a quadratic energy over the hinges of its triangles, whose Hessian is constant,
// positive semi-definite and a scalar per block, so that no state of the cloth, however collapsed, can
// break it, and a step only adds numbers that were computed once.
//
// The jump of slope across a hinge is the vector K x of Bergou et al., "A quadratic bending model for
// inextensible surfaces" (SGP 2006): K from the cotangents of its two triangles unfolded, |K x| =
// 2 |e| sin(theta/2) where they keep their lengths. Per area, k = K x / (A0 + A1) is a curvature in
// space [1/m].
// Their energy ½ D Σ 3 |K x|²/(A0 + A1) counts each hinge by itself and depends on the mesh: on
// rectangles cut along one diagonal a cylinder has 3 times its energy ½ D/R² per area, and 9 times
// where it bends along the diagonals; no choice of D by the direction of a hinge mends that, since
// ν and the twist couple hinges. So the hinges of a triangle are taken together, as in rotation-free
// plate elements (Oñate and Zárate, "Rotation-free triangular plate and shell elements", 2000):
//   E = Σ_triangles A min ½ κ·D·κ   over the curvatures κ that its hinges allow, k_i = g_i·κ,
// where g_i says what a constant curvature does to hinge i. With three hinges κ is the curvature of the
// quadric through six points; where one is missing, at a free edge, the minimum is the absence of a
// moment there. In closed form E = Σ A ½ k·(G D^-1 G^T)^-1 k, with any symmetric positive definite D.
//
// Only sides of the rest triangles enter, each pair unfolded about its edge: panels sewn together may
// lie anywhere and turned in the rest plane; directions 1 and 2 are those of each triangle's own panel.
//
// Limits. The energy of a constant curvature is exact on any mesh, but in equilibrium an irregular
// one is somewhat too soft: 1 to 3 % where vertices are displaced by a quarter of the mesh width,
// below 0.5 % for a tenth. Along free edges the energy of a shape that the cloth would not take by
// itself misses a strip of half a cell. Six points on a conic determine no quadric: singular values
// of G are kept above a fifth. The model knows isometric bending: a stretch that varies from
// triangle to triangle costs bending energy too, little beside its membrane energy. The resistance
// of a hinge grows with sin(theta): it is largest at 90° and vanishes in a complete fold.
#pragma once

#include "meshes/cloth_mesh.h"
#include "shell/term.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace homespun::shell
{
/// Bending stiffness of an orthotropic plate: moments (M11, M22, M12) = D (κ11, κ22, 2 κ12).
struct PlateStiffness
{
  double D11 = 0.; ///< about direction 2, bending along 1 [N m]
  double D22 = 0.; ///< [N m]
  double D12 = 0.; ///< what bending along 1 asks of moments along 2 [N m]
  double D66 = 0.; ///< twist: M12 = D66 2 κ12 [N m]

  /// D in both directions, D12 = nu D, D66 = D (1 − nu)/2; D = E t³/(12 (1 − nu²)) of a thick sheet.
  static PlateStiffness isotropic(double D, double nu);

  /// (3,3), Voigt order 11, 22, 12 [N m]
  Eigen::Matrix3d matrix() const;
};

/// Bending about a flat rest shape.
/// @param stiffness one per phase of mesh.rest [N m], positive definite
/// @throws BadInput with all faults: stiffness, phases, indices, rest triangles without area, edges of
///   more than two triangles or of two that traverse it the same way
std::unique_ptr<Term> bending_term(const meshes::ClothMesh &mesh,
                                   const std::vector<PlateStiffness> &stiffness);

/// What turns the flat rest shape of bending_term() into a curved one; to be used beside it with
/// the same stiffness. Per hinge it adds −(stiffness) tan(theta0) sin(theta), sin(theta) from the
/// volume of its four vertices, a cubic of the positions (Garg et al., "Cubic shells", SCA 2007).
/// With the quadratic energy, (stiffness) (1 − cos(theta)), this is one of −cos(theta − theta0):
/// the hinge rests at theta0 against isometric motions; forces in the plane, small beside membrane
/// forces, remain. Where hinges are coupled the rest shape is met to the second order of their
/// angles.
/// @param curved_rest_positions (n,3) where the cloth is without moments; its triangles should have
///   the shapes of those at rest [m]
/// @throws BadInput as bending_term(), for positions that are not finite, and for hinges that are
///   bent by more than 80°
std::unique_ptr<Term> curved_rest_term(const meshes::ClothMesh &mesh,
                                       const std::vector<PlateStiffness> &stiffness,
                                       const Vectors &curved_rest_positions);
} // namespace homespun::shell
