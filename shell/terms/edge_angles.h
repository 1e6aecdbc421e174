// SPDX-License-Identifier: MIT
// Bending of a cloth on any mesh: the angles at its edges, and one more unknown per edge that says
// where between the two triangles the tangent plane of the edge's middle lies.
//
//   κ_t = 1/A Σ_e |e| a_e n_e n_e^T,   a_e = θ_e/2 ± φ_e,   E(x) = min over φ of Σ_t ½ A κ_t·D·κ_t
//
// A, |e| and the normals n_e in the plane of triangle t are those at rest, θ_e is the signed angle
// between the two triangles in space; + holds on one side of an edge, − on the other. At the
// outline a_e = φ_e, which no other energy has: the minimum is the absence of a moment, a free
// edge. Linearised this is Morley's element. With φ = 0, the averaged normal, it is not consistent.
//
// The minimum over φ is taken exactly, by duality. There the moments of both sides of an edge
// agree; r_e, what the edge carries [N m], and θ are then linear in each other,
//   Σ_t K_t^-1 r = C r = θ,   E = ½ θ·C^-1 θ,   dE/dx = r·dθ/dx,   K_t = A G_t^T D G_t,   κ = G_t
//   a,
// where C couples the edges of a triangle only, and is factored once: the lowest element of Hellan,
// Herrmann and Johnson (Arnold and Brezzi, "Mixed and nonconforming finite element methods", 1985;
// nonlinear: Neunteufel and Schöberl, "The Hellan-Herrmann-Johnson method for nonlinear shells",
// 2019; normals of edges with an unknown of their own: Grinspun et al., "Computing discrete shape
// operators on general meshes", 2006). C^-1 is full, and a step's matrix takes
//   ψ_e = φ_e + half the difference of how far both triangles turn about the edge
// as unknowns (Term::take_nodes()): then a_e depends on ψ_e and on the corners of its own triangle,
// and the Hessian couples nothing but those, a membrane's pattern and that of the edges.
//
// Order two in positions and one in the energy norm on any regular family of meshes, with any D per
// triangle; motions in a plane cost nothing, exactly. Limits. θ jumps at a complete fold, from π to
// −π. A triangle that is a line has no normal: its energy is infinite. No discrete gradient:
// conserving steps take bending.h.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/membrane/plate_stiffness.h"
#include "shell/terms/edge_plates.h"
#include "shell/terms/term.h"

#include <memory>
#include <vector>

namespace homespun::shell
{
/// Bending about a flat rest shape.
/// @param stiffness one per phase of mesh.rest [N m], positive definite
/// @throws BadInput with all faults: stiffness, phases, indices, rest triangles without area, edges
///   of more than two triangles or of two that traverse it the same way, a clamp elsewhere than at
///   the outline or without a normal
std::unique_ptr<Term> edge_angles_term(const meshes::ClothMesh &mesh,
                                       const std::vector<PlateStiffness> &stiffness,
                                       const std::vector<ClampedEdge> &clamps = {});
} // namespace homespun::shell
