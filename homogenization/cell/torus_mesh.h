// SPDX-License-Identifier: MIT
// A unit cell with its opposite sides glued together: a mesh of the torus. Vertices and edges that
// are lattice images of each other are one, so that periodicity needs no constraint and bisection
// refines both sides of the cell alike.
//
// Shape stands in the vectors of the edges, not in coordinates: halves and sums of them keep their
// relative precision however deep the mesh is refined towards a corner, where differences
// of coordinates end at 1e-16 of the cell. A stress that grows like r^(-0.96), as in a checkerboard
// of contrast 1000, needs triangles far smaller than that.
#pragma once

#include "homogenization/cell/curved_sides.h"
#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <vector>

namespace homespun::homogenization
{
/// An edge of the torus; both of its triangles see the same vector.
struct TorusEdge
{
  int tail, head;         ///< vertices of the torus
  Eigen::Vector2d vector; ///< from tail to head [m]
  /// From the middle of the edge to the middle of the parabola that the drawing has there, x(t) =
  /// tail + t vector + 4 t (1 − t) bulge [m]; zero where it is straight, and on edges inside of a
  /// phase.
  Eigen::Vector2d bulge = Eigen::Vector2d::Zero();
};

/// A triangle of the torus, counter-clockwise. Edge k joins the vertices k and k + 1; edge 0 is the
/// one that is bisected next, vertex 2 the newest.
struct TorusTriangle
{
  std::array<int, 3> vertices;
  std::array<int, 3> edges;
  std::array<double, 3> signs; ///< +1 where the edge runs from vertex k to vertex k + 1, else −1
  int material;
  Eigen::Vector2d corner; ///< where vertex 0 lies in the plane [m]

  /// The corners relative to the first one [m].
  std::array<Eigen::Vector2d, 3> shape(const std::vector<TorusEdge> &all_edges) const
  {
    return {Eigen::Vector2d::Zero(),
            signs[0] * all_edges[static_cast<std::size_t>(edges[0])].vector,
            -signs[2] * all_edges[static_cast<std::size_t>(edges[2])].vector};
  }
};

/// Where a vertex lies, seen from the vertex of the given mesh that it descends from.
struct VertexOrigin
{
  int vertex;             ///< of the given mesh, as a vertex of the torus
  Eigen::Vector2d offset; ///< from it [m]
};

/// The glued mesh; plain data, made and refined by the functions below.
struct TorusMesh
{
  meshes::Lattice lattice;
  int n_vertices = 0; ///< those of the given mesh come first
  std::vector<TorusEdge> edges;
  std::vector<TorusTriangle> triangles;
  std::vector<VertexOrigin> origins;   ///< of each vertex
  std::vector<double> reach;           ///< shortest edge at each vertex of the given mesh [m]
  std::vector<int> vertex_of_original; ///< vertex of the torus for each one of the given mesh
  int anchor = 0;                      ///< vertex at the lattice points

  int n_triangles() const
  {
    return static_cast<int>(triangles.size());
  }
  int n_edges() const
  {
    return static_cast<int>(edges.size());
  }
  /// Whether any side of a phase is curved: the mesh then stands for a drawing, not for itself.
  bool is_drawn() const
  {
    return n_arcs() > 0;
  }
  int n_arcs() const
  {
    return static_cast<int>(std::count_if(
      edges.begin(), edges.end(), [](const TorusEdge &edge) { return !edge.bulge.isZero(0.); }));
  }
};

/// Glues a periodic mesh. Images are moved onto each other exactly: where the sides of the given
/// mesh match within the tolerance of match_images() only, its shape changes by that much.
/// The longest edge of each triangle is bisected first.
/// @param curved_sides of the mesh; those between two materials and on rims are kept
/// @throws BadInput where the outline is not periodic, or its images are curved differently
TorusMesh glued(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                const std::vector<CurvedSide> &curved_sides = {});

/// Bisects all three edges of the marked triangles, and as many more as keep the mesh conforming
/// (newest-vertex bisection: the angles stay those of at most four shapes per given triangle, and
/// come near to those where edges are curved). Children inherit the material. A curved edge is
/// bisected at the middle of its parabola, whose halves have a quarter of its bulge.
/// @param is_marked (n_triangles)
TorusMesh bisected(const TorusMesh &mesh, const std::vector<char> &is_marked);

/// The edges with a triangle on one side only: the rims of holes, each as {triangle, edge of it}.
std::vector<std::array<int, 2>> rim_edges(const TorusMesh &mesh);

/// The shortest edge, relative to sqrt(|Y|).
double relative_resolution(const TorusMesh &mesh);
} // namespace homespun::homogenization
