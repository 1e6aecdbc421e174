// SPDX-License-Identifier: MIT
// The hinges of a cloth: what its triangles say about curvature, measured once at rest. bending.h
// makes an energy of it.
//
// The jump of slope across a hinge is the vector K x of Bergou et al., "A quadratic bending model
// for inextensible surfaces" (SGP 2006): K from the cotangents of its two triangles unfolded, |K x|
// = 2 |e| sin(theta/2) where they keep their lengths. Per area, k = K x / (A0 + A1) is a curvature
// in space [1/m].
// A constant curvature κ of the cloth gives hinge i of a triangle k_i = g_i·κ. The hinges of a
// triangle, three or fewer, are its patch, with the stiffness A (G D^-1 G^T)^-1 (bending.h says
// why).
//
// Only sides of the rest triangles enter, each pair unfolded about its edge: panels sewn together
// may lie anywhere and turned in the rest plane; directions 1 and 2 are those of each triangle's
// own panel. Six points on a conic determine no quadric: singular values of G are kept above a
// fifth.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/membrane/plate_stiffness.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::shell
{
/// One hinge as one of its triangles sees it.
struct HalfHinge
{
  int opposite  = -1; ///< vertex of the neighbour, −1 at the outline
  int neighbour = -1, neighbour_corner = -1;
  double length = 0.;           ///< of the edge in this triangle at rest [m]
  Eigen::Vector4d weights;      ///< k = Σ weights x over corners k + 1, k + 2, k, opposite [1/m²]
  Eigen::RowVector3d curvature; ///< g: k = g·κ (Voigt, engineering twist) [-]
};

/// A triangle with the hinges that it has: rows of the quadratic form.
struct Patch
{
  std::vector<int> corner;   ///< of the triangle, opposite to the hinge
  Eigen::MatrixXd stiffness; ///< A (G D^-1 G^T)^-1 over these hinges [N m^3]
};

struct Hinges
{
  std::vector<std::array<HalfHinge, 3>> of; ///< (m) hinge opposite to each corner
  std::vector<Patch> patches;               ///< (m)
  std::vector<double> area;                 ///< (m) at rest [m^2]
};

/// Which triangles share an edge in space, with the areas; weights, curvatures and patches are
/// empty.
/// @param stiffness one per phase of mesh.rest [N m], positive definite
/// @throws BadInput as hinges_of()
Hinges neighbours_of(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness);

/// Measures the hinges of a cloth at rest.
/// @param stiffness one per phase of mesh.rest [N m], positive definite
/// @throws BadInput with all faults: stiffness, phases, indices, rest triangles without area, edges
///   of more than two triangles or of two that traverse it the same way
Hinges hinges_of(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness);

/// The four vertices of a hinge in the order of its weights.
/// @param corner of triangle t, opposite to the hinge
std::array<int, 4> vertices_of(const meshes::ClothMesh &mesh, int t, int corner,
                               const HalfHinge &hinge);
} // namespace homespun::shell
