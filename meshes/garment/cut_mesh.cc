// SPDX-License-Identifier: MIT
#include "meshes/garment/cut_mesh.h"

#include <algorithm>
#include <cmath>

namespace homespun::meshes
{
namespace
{
std::uint64_t key(const int a, const int b)
{
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) |
         static_cast<std::uint32_t>(b);
}

} // namespace

CutMesh::CutMesh(std::vector<Eigen::RowVector2d> points, std::vector<std::array<int, 2>> edges,
                 const double tolerance)
    : points(std::move(points))
    , edges(std::move(edges))
    , tolerance(tolerance)
{
  vertex_of_point.assign(this->points.size(), -1);
  edges_of_point.resize(this->points.size());
  near_edge.resize(this->edges.size());
  for (std::size_t e = 0; e < this->edges.size(); ++e)
    for (const int point : this->edges[e])
      edges_of_point[static_cast<std::size_t>(point)].push_back(static_cast<int>(e));
}

int CutMesh::add_vertex(const Eigen::RowVector2d &x)
{
  vertices.push_back({x, -1, {}});
  return static_cast<int>(vertices.size()) - 1;
}

void CutMesh::add_triangle(const std::array<int, 3> &corners, const int parent,
                           std::vector<int> near)
{
  const int triangle = static_cast<int>(triangles.size());
  for (const int e : near)
    near_edge[static_cast<std::size_t>(e)].push_back(triangle);
  triangles.push_back({corners, parent, std::move(near)});
  set_corners(triangle, corners);
}

void CutMesh::set_corners(const int triangle, const std::array<int, 3> &corners)
{
  triangles[static_cast<std::size_t>(triangle)].corners = corners;
  for (std::size_t k = 0; k < 3; ++k)
    left[key(corners[k], corners[(k + 1) % 3])] = triangle;
}

void CutMesh::copy_triangle(const int triangle, const std::array<int, 3> &corners)
{
  const Triangle &old = triangles[static_cast<std::size_t>(triangle)];
  add_triangle(corners, old.parent, std::vector<int>(old.near));
}

void CutMesh::refuse(const Eigen::RowVector2d &x) const
{
  throw Conflict{x};
}

int CutMesh::triangle_left_of(const int a, const int b) const
{
  const auto found = left.find(key(a, b));
  return found == left.end() ? -1 : found->second;
}

double CutMesh::area(const int triangle) const
{
  const auto [a, b, c]         = triangles[static_cast<std::size_t>(triangle)].corners;
  const Eigen::RowVector2d &x0 = vertices[static_cast<std::size_t>(a)].x;
  return 0.5 * cross(vertices[static_cast<std::size_t>(b)].x - x0,
                     vertices[static_cast<std::size_t>(c)].x - x0);
}

bool CutMesh::lies_on(const int vertex, const int edge) const
{
  for (const OutlinePoint &place : vertices[static_cast<std::size_t>(vertex)].outline)
    if (place.edge == edge)
      return true;
  return false;
}

double CutMesh::part_of(const int vertex, const int edge) const
{
  for (const OutlinePoint &place : vertices[static_cast<std::size_t>(vertex)].outline)
    if (place.edge == edge)
      return place.part;
  refuse(vertices[static_cast<std::size_t>(vertex)].x);
}

std::vector<int> CutMesh::common_edges(const int a, const int b) const
{
  std::vector<int> common;
  for (const OutlinePoint &place : vertices[static_cast<std::size_t>(a)].outline)
    if (lies_on(b, place.edge))
      common.push_back(place.edge);
  return common;
}

double CutMesh::height(const std::array<int, 3> &corners, const Eigen::RowVector2d &apex,
                       const int side) const
{
  const Eigen::RowVector2d
    &from = vertices[static_cast<std::size_t>(corners[static_cast<std::size_t>(side)])].x,
    &to   = vertices[static_cast<std::size_t>(corners[static_cast<std::size_t>((side + 1) % 3)])].x;
  return cross(to - from, apex - from) / (to - from).norm();
}

bool CutMesh::move(const int vertex, const Eigen::RowVector2d &x, const std::vector<int> &around)
{
  for (const int t : around)
  {
    const auto &corners = triangles[static_cast<std::size_t>(t)].corners;
    for (int k = 0; k < 3; ++k)
      if (corners[static_cast<std::size_t>((k + 2) % 3)] == vertex)
      {
        const double before = height(corners, vertices[static_cast<std::size_t>(vertex)].x, k);
        if (!(height(corners, x, k) > 0.5 * before))
          return false;
      }
  }
  vertices[static_cast<std::size_t>(vertex)].x = x;
  return true;
}

void CutMesh::split_edge(const int a, const int b, const int vertex)
{
  // What lies on a segment of the outline stays on it.
  for (const int e : common_edges(a, b))
  {
    const auto &ends               = edges[static_cast<std::size_t>(e)];
    const Eigen::RowVector2d &from = points[static_cast<std::size_t>(ends[0])],
                             &to   = points[static_cast<std::size_t>(ends[1])];
    Vertex &made                   = vertices[static_cast<std::size_t>(vertex)];
    if (!lies_on(vertex, e))
      made.outline.push_back({e, (made.x - from).dot(to - from) / (to - from).squaredNorm()});
  }
  for (const auto &[from, to] : {std::array<int, 2>{a, b}, std::array<int, 2>{b, a}})
  {
    const int t = triangle_left_of(from, to);
    if (t < 0)
      continue;
    const auto corners = triangles[static_cast<std::size_t>(t)].corners;
    const int opposite = corners[0] != a && corners[0] != b   ? corners[0]
                         : corners[1] != a && corners[1] != b ? corners[1]
                                                              : corners[2];
    vertices[static_cast<std::size_t>(vertex)].parent =
      triangles[static_cast<std::size_t>(t)].parent;
    left.erase(key(from, to));
    set_corners(t, {from, vertex, opposite});
    copy_triangle(t, {vertex, to, opposite});
  }
}

void CutMesh::split_triangle(const int triangle, const int vertex)
{
  const auto [a, b, c] = triangles[static_cast<std::size_t>(triangle)].corners;
  vertices[static_cast<std::size_t>(vertex)].parent =
    triangles[static_cast<std::size_t>(triangle)].parent;
  copy_triangle(triangle, {b, c, vertex});
  copy_triangle(triangle, {c, a, vertex});
  set_corners(triangle, {a, b, vertex});
}

std::vector<int> CutMesh::along(const int edge) const
{
  std::vector<int> chain;
  for (const int t : near_edge[static_cast<std::size_t>(edge)])
    for (const int v : triangles[static_cast<std::size_t>(t)].corners)
      if (lies_on(v, edge))
        chain.push_back(v);
  std::sort(chain.begin(), chain.end());
  chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
  std::sort(chain.begin(), chain.end(),
            [&](const int a, const int b) { return part_of(a, edge) < part_of(b, edge); });
  return chain;
}

void CutMesh::slide(const int vertex, const int edge, const double part)
{
  const auto &ends = edges[static_cast<std::size_t>(edge)];
  Vertex &moved    = vertices[static_cast<std::size_t>(vertex)];
  moved.x =
    points[static_cast<std::size_t>(ends[0])] +
    part * (points[static_cast<std::size_t>(ends[1])] - points[static_cast<std::size_t>(ends[0])]);
  for (OutlinePoint &place : moved.outline)
    if (place.edge == edge)
      place.part = part;
}

int CutMesh::split_outline(const int edge, const int before, const int after, const double part)
{
  const int vertex = add_vertex({0., 0.});
  vertices[static_cast<std::size_t>(vertex)].outline.push_back({edge, part});
  slide(vertex, edge, part);
  split_edge(before, after, vertex);
  return vertex;
}

std::vector<int> CutMesh::sides_of_outline() const
{
  std::vector<int> sides(triangles.size(), -2), reached;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed)
  {
    if (sides[seed] != -2)
      continue;
    // A part of the mesh without outline inside it, and what its edges on the outline say of it.
    int verdict = -1;
    reached     = {static_cast<int>(seed)};
    sides[seed] = -1;
    for (std::size_t next = 0; next < reached.size(); ++next)
    {
      const auto &corners = triangles[static_cast<std::size_t>(reached[next])].corners;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const int a = corners[k], b = corners[(k + 1) % 3];
        const std::vector<int> common = common_edges(a, b);
        if (!common.empty())
        {
          // On a slit both sides are inside: one edge each way.
          bool is_inside = false;
          for (const int e : common)
            is_inside = is_inside || part_of(a, e) < part_of(b, e);
          if (verdict == (is_inside ? 0 : 1))
            refuse(vertices[static_cast<std::size_t>(a)].x);
          verdict = is_inside ? 1 : 0;
        }
        else if (const int other = triangle_left_of(b, a);
                 other >= 0 && sides[static_cast<std::size_t>(other)] == -2)
        {
          sides[static_cast<std::size_t>(other)] = -1;
          reached.push_back(other);
        }
      }
    }
    for (const int t : reached)
      sides[static_cast<std::size_t>(t)] = verdict;
  }
  return sides;
}
} // namespace homespun::meshes
