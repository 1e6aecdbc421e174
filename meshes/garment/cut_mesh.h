// SPDX-License-Identifier: MIT
// A mesh cut along the outline of a panel, so that the outline becomes edges of the mesh. Every
// crossing splits one edge, and with it the triangles on both sides: the mesh conforms at every
// moment, whatever the shape of the outline. Private to fine_cloth.
#pragma once

#include "meshes/plain/cross.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace homespun::meshes
{
class CutMesh
{
public:
  /// A place on the outline: edge, and part of its length from its first end.
  struct OutlinePoint
  {
    int edge;
    double part;
  };
  struct Triangle
  {
    std::array<int, 3> corners;
    int parent;            ///< what the caller called the triangle that it was cut from
    std::vector<int> near; ///< edges of the outline that may cross it
  };
  struct Vertex
  {
    Eigen::RowVector2d x;
    int parent; ///< of the triangle in which it was made; −1 where the caller gave it
    std::vector<OutlinePoint> outline; ///< where it lies on the outline; empty inside
  };

  /// @param points corners of the outline [m], near the origin: round-off counts from there
  /// @param edges of the outline by their two points, the panel on the left
  /// @param tolerance a vertex nearer than this to the outline is moved onto it [m]
  CutMesh(std::vector<Eigen::RowVector2d> points, std::vector<std::array<int, 2>> edges,
          double tolerance);

  int add_vertex(const Eigen::RowVector2d &x);

  /// @param near edges of the outline that may cross the triangle, or come nearer than the
  ///   tolerance
  void add_triangle(const std::array<int, 3> &corners, int parent, std::vector<int> near);

  /// Thrown where the outline cannot become edges of the mesh: it crosses itself, or has details
  /// smaller than the tolerance.
  struct Conflict
  {
    Eigen::RowVector2d x; ///< near there [m]
  };

  /// Cuts. The triangles near the outline must be there, conforming, and cover it.
  /// @throws Conflict
  void cut();

  /// Vertices along an edge of the outline in the order of their parts, both ends included.
  std::vector<int> along(int edge) const;

  /// Part of the length of an edge at which a vertex lies; it must lie there.
  double part_of(int vertex, int edge) const;

  /// Moves a vertex inside an edge of the outline along it.
  void slide(int vertex, int edge, double part);

  /// Splits the mesh edge between two neighbours along an edge of the outline.
  /// @return the new vertex
  int split_outline(int edge, int before, int after, double part);

  /// Edges of the outline on which both vertices lie.
  std::vector<int> common_edges(int a, int b) const;

  /// The triangle on the left of the mesh edge from a to b, −1: none.
  int triangle_left_of(int a, int b) const;

  /// Signed area of a triangle [m^2].
  double area(int triangle) const;

  /// For every triangle: 1 inside the panel, 0 outside, −1 where its part of the mesh does not
  /// touch the outline.
  /// @throws Conflict
  std::vector<int> sides_of_outline() const;

  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;

private:
  double height(const std::array<int, 3> &corners, const Eigen::RowVector2d &apex, int side) const;
  bool move(int vertex, const Eigen::RowVector2d &x, const std::vector<int> &around);
  void insert_point(int point);
  void insert_edge(int edge);
  void split_edge(int a, int b, int vertex);
  void split_triangle(int triangle, int vertex);
  void copy_triangle(int triangle, const std::array<int, 3> &corners);
  void set_corners(int triangle, const std::array<int, 3> &corners);
  bool lies_on(int vertex, int edge) const;
  [[noreturn]] void refuse(const Eigen::RowVector2d &x) const;

  std::vector<Eigen::RowVector2d> points;
  std::vector<std::array<int, 2>> edges;
  double tolerance;
  std::vector<int> vertex_of_point;
  std::vector<std::vector<int>> edges_of_point;
  std::vector<std::vector<int>> near_edge;     ///< triangles that an edge of the outline may cross
  std::unordered_map<std::uint64_t, int> left; ///< triangle on the left of a directed mesh edge
};
} // namespace homespun::meshes
