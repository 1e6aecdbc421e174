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

void CutMesh::insert_point(const int point)
{
  const Eigen::RowVector2d &x = points[static_cast<std::size_t>(point)];
  std::vector<int> candidates;
  for (const int e : edges_of_point[static_cast<std::size_t>(point)])
    candidates.insert(candidates.end(), near_edge[static_cast<std::size_t>(e)].begin(),
                      near_edge[static_cast<std::size_t>(e)].end());
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());

  int nearest = -1, holder = -1, holder_side = 0;
  double distance = tolerance, depth = -tolerance;
  for (const int t : candidates)
  {
    const auto &corners = triangles[static_cast<std::size_t>(t)].corners;
    for (const int v : corners)
      if (const double d = (vertices[static_cast<std::size_t>(v)].x - x).norm(); d <= distance)
      {
        nearest  = v;
        distance = d;
      }
    int side      = 0;
    double lowest = height(corners, x, 0);
    for (int k = 1; k < 3; ++k)
      if (const double h = height(corners, x, k); h < lowest)
      {
        lowest = h;
        side   = k;
      }
    if (lowest > depth)
    {
      depth       = lowest;
      holder      = t;
      holder_side = side;
    }
  }
  int vertex = -1;
  if (nearest >= 0)
  {
    // Where two points of the outline coincide (a slit, loops that touch), they share the vertex.
    const bool is_taken = !vertices[static_cast<std::size_t>(nearest)].outline.empty();
    if (is_taken ? distance <= 1e-3 * tolerance : move(nearest, x, candidates))
      vertex = nearest;
  }
  if (vertex < 0 && holder < 0)
    refuse(x);
  if (vertex < 0)
  {
    vertex             = add_vertex(x);
    const auto corners = triangles[static_cast<std::size_t>(holder)].corners;
    const int a        = corners[static_cast<std::size_t>(holder_side)],
              b        = corners[static_cast<std::size_t>((holder_side + 1) % 3)];
    // On an edge of the mesh, if the triangles on both sides then stay as they should be.
    bool splits_edge = depth < tolerance;
    for (const int t : {triangle_left_of(a, b), triangle_left_of(b, a)})
      for (int k = 0; splits_edge && t >= 0 && k < 3; ++k)
      {
        const auto &around = triangles[static_cast<std::size_t>(t)].corners;
        const int from     = around[static_cast<std::size_t>(k)],
                  to       = around[static_cast<std::size_t>((k + 1) % 3)];
        if (!(from == a && to == b) && !(from == b && to == a))
          splits_edge = height(around, x, k) > 0.;
      }
    if (splits_edge)
      split_edge(a, b, vertex);
    else if (depth > 0.)
      split_triangle(holder, vertex);
    else
      refuse(x);
  }
  vertex_of_point[static_cast<std::size_t>(point)] = vertex;
  for (const int e : edges_of_point[static_cast<std::size_t>(point)])
    if (!lies_on(vertex, e))
      vertices[static_cast<std::size_t>(vertex)].outline.push_back(
        {e, edges[static_cast<std::size_t>(e)][0] == point ? 0. : 1.});
}

void CutMesh::insert_edge(const int edge)
{
  const auto &ends              = edges[static_cast<std::size_t>(edge)];
  const Eigen::RowVector2d from = points[static_cast<std::size_t>(ends[0])],
                           span = points[static_cast<std::size_t>(ends[1])] - from;
  const double length           = span.norm();
  const std::vector<int> before = near_edge[static_cast<std::size_t>(edge)];

  // Vertices next to the edge move onto it, where that harms no triangle.
  std::vector<std::array<int, 2>> incidences; // vertex, triangle
  for (const int t : before)
    for (const int v : triangles[static_cast<std::size_t>(t)].corners)
      incidences.push_back({v, t});
  std::sort(incidences.begin(), incidences.end());
  std::vector<int> around;
  for (std::size_t k = 0; k < incidences.size(); ++k)
  {
    around.push_back(incidences[k][1]);
    const int v = incidences[k][0];
    if (k + 1 < incidences.size() && incidences[k + 1][0] == v)
      continue;
    const Vertex &vertex  = vertices[static_cast<std::size_t>(v)];
    const double part     = (vertex.x - from).dot(span) / (length * length);
    const double distance = std::abs(cross(span, vertex.x - from)) / length;
    if (!lies_on(v, edge) && part > 0. && part < 1. && distance <= tolerance)
    {
      const bool is_taken = !vertex.outline.empty();
      if (is_taken ? distance <= 1e-3 * tolerance : move(v, from + part * span, around))
        vertices[static_cast<std::size_t>(v)].outline.push_back({edge, part});
    }
    around.clear();
  }

  // Every mesh edge that crosses is split; the new triangles are looked at in turn.
  std::vector<int> &pending = near_edge[static_cast<std::size_t>(edge)];
  for (std::size_t next = 0; next < pending.size(); ++next)
    for (bool found = true; found;)
    {
      found              = false;
      const auto corners = triangles[static_cast<std::size_t>(pending[next])].corners;
      for (std::size_t k = 0; k < 3 && !found; ++k)
      {
        const int a = corners[k], b = corners[(k + 1) % 3];
        if (lies_on(a, edge) || lies_on(b, edge))
          continue;
        const Eigen::RowVector2d xa = vertices[static_cast<std::size_t>(a)].x,
                                 xb = vertices[static_cast<std::size_t>(b)].x;
        const double sa = cross(span, xa - from), sb = cross(span, xb - from);
        if ((sa > 0.) == (sb > 0.) || sa == 0. || sb == 0.)
          continue;
        const Eigen::RowVector2d x = xa + sa / (sa - sb) * (xb - xa);
        const double part          = (x - from).dot(span) / (length * length);
        if (!(part > 0.) || !(part < 1.))
          continue;
        const int vertex = add_vertex(from + part * span);
        vertices[static_cast<std::size_t>(vertex)].outline.push_back({edge, part});
        split_edge(a, b, vertex);
        found = true;
      }
    }
}

void CutMesh::cut()
{
  for (std::size_t point = 0; point < points.size(); ++point)
    insert_point(static_cast<int>(point));
  for (std::size_t e = 0; e < edges.size(); ++e)
    insert_edge(static_cast<int>(e));
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    const std::vector<int> chain = along(static_cast<int>(e));
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      if (triangle_left_of(chain[k], chain[k + 1]) < 0 ||
          triangle_left_of(chain[k + 1], chain[k]) < 0)
        refuse(vertices[static_cast<std::size_t>(chain[k])].x);
  }
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
