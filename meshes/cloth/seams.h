// SPDX-License-Identifier: MIT
// Panels and seams of a cloth: which triangles are one piece at rest, and where two pieces are
// sewn.
#pragma once

#include "meshes/cloth/cloth_mesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::meshes
{
/// The panels of a cloth, counted from 0 in the order of their first triangle. Triangles that share
/// a rest vertex belong to one panel.
struct Panels
{
  int count = 0;
  Eigen::VectorXi of_vertex;   ///< (n_rest), −1 for a vertex without triangle
  Eigen::VectorXi of_triangle; ///< (m)
};
Panels panels_of(const ClothMesh &cloth);

/// One side of one triangle, from corner `side` to corner side + 1 modulo 3.
struct Side
{
  int triangle, side;
};

/// The outlines of all panels, sewn or not: sides that have no other triangle at rest.
std::vector<Side> open_sides(const ClothMesh &cloth);

/// An edge in space between two triangles that is no edge at rest: the sides were sewn together. In
/// space the second triangle runs along it the other way.
struct SeamEdge
{
  std::array<Side, 2> sides;
};

/// All seam edges, in the order of their first triangle.
/// @param cloth without faults (cloth_faults.h)
std::vector<SeamEdge> seam_edges(const ClothMesh &cloth);

/// The angle that the cloth fills at rest around each vertex in space that stands for several rest
/// vertices [rad]; 0 elsewhere.
Eigen::VectorXd sewn_angles(const ClothMesh &cloth);

/// The rest vertices at the two ends of a side.
std::array<int, 2> rest_ends(const ClothMesh &cloth, const Side &side);

/// The vertices in space at the two ends of a side.
std::array<int, 2> space_ends(const ClothMesh &cloth, const Side &side);

/// The vertex in space of each rest vertex, shape (n_rest); −1 for a vertex without triangle.
Eigen::VectorXi space_of_rest(const ClothMesh &cloth);
} // namespace homespun::meshes
