// SPDX-License-Identifier: MIT
// What edge_angles.h knows of a cloth at rest: its edges, what each triangle sets against the
// angles at its own, and where in a step's matrix the unknowns of edges stand.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/membrane/plate_stiffness.h"

#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace homespun::shell
{
/// An edge of the outline whose tangent plane is given: a_e is the angle from there to its
/// triangle. Its ends are to be held, on a line in that plane.
struct ClampedEdge
{
  int first = 0, second = 0; ///< vertices in space, in either order
  Eigen::Vector3d normal;    ///< of the plane, on the side of the triangle's own
};

/// Between two triangles, or of one and the plane of a clamp.
struct PlateEdge
{
  std::array<int, 2> triangle, corner; ///< opposite corner; the second −1: a clamp
  Eigen::Vector3d normal;              ///< of the clamp
  struct Place
  {
    int node = -1, component = -1;
  } place; ///< where its unknown is, if it has one
};

/// A triangle's stiffness against the angles a at its edges.
struct EdgePlate
{
  Eigen::Matrix3d K; ///< A G^T D G, free edges without a moment: their rows are zero [N m]
  std::array<int, 3> edge    = {-1, -1, -1}; ///< opposite to each corner; −1: free
  std::array<double, 3> sign = {0., 0., 0.}; ///< of ψ in a; 0: the edge has no unknown
};

struct EdgePlates
{
  using Place = PlateEdge::Place;
  std::vector<PlateEdge> edges;           ///< between triangles, then clamps; no free ones
  std::vector<EdgePlate> plates;          ///< (m)
  Eigen::SparseMatrix<double> compliance; ///< C: θ = C r, over the edges [1/(N m)]
  /// Three edges to a node, those that one vertex has in common: there are about as many nodes as
  /// vertices, and the matrix keeps its blocks.
  int n_nodes = 0;
  std::vector<Place> padding; ///< that no edge has
};

/// @throws BadInput as edge_angles_term()
EdgePlates edge_plates(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness,
                       const std::vector<ClampedEdge> &clamps);

/// θ, positive where corners that move along their normals make it grow.
/// @param x positions of the vertices in space (n,3) [m]
Eigen::VectorXd angles_at_edges(const std::vector<PlateEdge> &edges,
                                const meshes::Triangles &triangles, const meshes::SpacePoints &x);

/// The moments M = D κ of each triangle at mesh.positions, of which the part across an edge is that
/// of its other triangle (m,3), Voigt order 11, 22, 12 [N].
/// @throws BadInput as edge_plates()
Eigen::MatrixX3d bending_moments(const meshes::ClothMesh &mesh,
                                 const std::vector<PlateStiffness> &stiffness,
                                 const std::vector<ClampedEdge> &clamps);
} // namespace homespun::shell
