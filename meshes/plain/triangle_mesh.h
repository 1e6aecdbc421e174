// SPDX-License-Identifier: MIT
// The triangle mesh that every part of homespun speaks of: a unit cell, a coarse cloth at rest, the
// resolved sheet. Plain data, in the plane; current positions are kept apart from it.
#pragma once

#include "meshes/plain/mesh_fault.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homespun::meshes
{
/// Points in the plane, one per row, shape (n,2) [m].
using Points = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
/// Vertex indices, one triangle per row, shape (m,3), counter-clockwise.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A mesh of counter-clockwise triangles at rest in the plane.
struct TriangleMesh
{
  Points vertices;          ///< (n,2) [m]
  Triangles triangles;      ///< (m,3)
  Eigen::VectorXi material; ///< (m) index of the phase of each triangle

  int n_vertices() const
  {
    return static_cast<int>(vertices.rows());
  }
  int n_triangles() const
  {
    return static_cast<int>(triangles.rows());
  }
};

/// Signed area of every triangle, ½ (x1 − x0) × (x2 − x0); positive when counter-clockwise.
/// @return (m) [m^2]
Eigen::VectorXd signed_areas(const TriangleMesh &mesh);

/// The edges that belong to one triangle only, each directed so that the mesh lies on its left.
/// @throws BadInput where more than two triangles share an edge, or two traverse it the same way
std::vector<std::array<int, 2>> boundary_edges(const TriangleMesh &mesh);

/// Boundary edges chained into closed loops of vertices, mesh on the left: the outline runs
/// counter-clockwise, holes run clockwise. Where loops touch in a vertex they are kept apart.
std::vector<std::vector<int>> boundary_loops(const TriangleMesh &mesh);

/// All that makes a mesh unusable for finite elements: indices out of range, coordinates that are
/// not finite, triangles that are inverted or have no area, triangles that occur twice, edges with
/// more than two triangles, vertices that no triangle uses. At most three messages per kind.
/// @param name of the mesh, put before each message, usually its file
std::vector<std::string> faults_of(const TriangleMesh &mesh, const std::string &name);

/// The same with their places.
std::vector<MeshFault> placed_faults_of(const TriangleMesh &mesh, const std::string &name);
} // namespace homespun::meshes
