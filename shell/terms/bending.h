// SPDX-License-Identifier: MIT
// Bending of a cloth: a quadratic energy over the hinges of its triangles, whose Hessian is
// constant, positive semi-definite and a scalar per block, so that no state of the cloth, however
// collapsed, can break it, and a step only adds numbers that were computed once.
//
// The energy ½ D Σ 3 |K x|²/(A0 + A1) of Bergou et al. (K: hinges.h) counts each hinge by itself
// and depends on the mesh: on rectangles cut along one diagonal a cylinder has 3 times its energy ½
// D/R² per area, and 9 times where it bends along the diagonals; no choice of D by the direction of
// a hinge mends that, since ν and the twist couple hinges. So the hinges of a triangle are taken
// together, as in rotation-free plate elements (Oñate and Zárate, "Rotation-free triangular plate
// and shell elements", 2000):
//   E = Σ_triangles A min ½ κ·D·κ   over the curvatures κ that its hinges allow, k_i = g_i·κ,
// where g_i says what a constant curvature does to hinge i. With three hinges κ is the curvature of
// the quadric through six points; where one is missing, at a free edge, the minimum is the absence
// of a moment there. In closed form E = Σ A ½ k·(G D^-1 G^T)^-1 k, with any symmetric positive
// definite D.
//
// Limits. The energy of a constant curvature is exact on any mesh, but only lattices cut along one
// diagonal keep it in equilibrium. Others are too soft, and stay so however fine they are: 1 to 3 %
// where vertices are displaced by a quarter of the mesh width, below 0.5 % for a tenth, a third
// where diagonals alternate. patch_test_gain() measures it, and what is too soft is refused:
// edge_angles.h converges on every mesh. Along free edges the energy of a shape that the cloth
// would not take by itself misses a strip of half a cell. The model knows isometric bending: a
// stretch that varies from triangle to triangle costs bending energy too, little beside its
// membrane energy. The resistance of a hinge grows with sin(theta): it is largest at 90° and
// vanishes in a complete fold.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/membrane/plate_stiffness.h"
#include "shell/terms/term.h"

#include <memory>
#include <vector>

namespace homespun::shell
{
/// What the plate gains by leaving a constant curvature that it could keep, over the energy of that
/// [-]: the panels lie flat, each of one phase's stiffness, two rings of vertices along their
/// outline held at curvatures 11, 22 and 12 in turn; the largest of all. Infinite where a part of a
/// panel, up to three quads across, has nothing inside the rings and is no lattice cut along one
/// diagonal to a tenth of an edge: then it is unknown.
/// @param stiffness one per phase [N m]
/// @throws BadInput as bending_term()
double patch_test_gain(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness);

/// Whether all triangles that share an edge are each other's images in its middle: there the gain
/// is round-off, on panels however narrow.
/// @param stiffness one per phase [N m]
/// @throws BadInput as bending_term()
bool is_cut_along_one_diagonal(const meshes::ClothMesh &mesh,
                               const std::vector<PlateStiffness> &stiffness);

/// The largest that is taken [-].
constexpr double largest_patch_test_gain = 0.01;

/// Bending about a flat rest shape.
/// @param stiffness one per phase of mesh.rest [N m], positive definite
/// @throws BadInput with all faults: stiffness, phases, indices, rest triangles without area, edges
///   of more than two triangles or of two that traverse it the same way; a mesh whose patch test
///   gains more than the largest, or an unknown part
std::unique_ptr<Term> bending_term(const meshes::ClothMesh &mesh,
                                   const std::vector<PlateStiffness> &stiffness);
} // namespace homespun::shell
