// SPDX-License-Identifier: MIT
// How points and edges of an outline become vertices and edges of the mesh.
#include "meshes/garment/cut_mesh.h"

#include <algorithm>
#include <cmath>

namespace homespun::meshes
{
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
} // namespace homespun::meshes
