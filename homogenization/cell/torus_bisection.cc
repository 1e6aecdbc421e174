// SPDX-License-Identifier: MIT
#include "homogenization/cell/torus_mesh.h"

#include "meshes/plain/index.h"

#include <algorithm>
#include <cmath>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// Both halves of an edge and the vertex between them.
struct Halves
{
  int midpoint = -1, first = -1, second = -1; ///< the first half holds the tail
};

/// The marked edges, and with every marked edge of a triangle the one that it bisects first.
std::vector<char> closure(const TorusMesh &mesh, const std::vector<char> &is_marked)
{
  std::vector<char> is_split(mesh.edges.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (is_marked[t])
      for (const int edge : mesh.triangles[t].edges)
        is_split[at(edge)] = 1;
  for (bool grows = true; grows;)
  {
    grows = false;
    for (const TorusTriangle &triangle : mesh.triangles)
      if (!is_split[at(triangle.edges[0])] &&
          (is_split[at(triangle.edges[1])] || is_split[at(triangle.edges[2])]))
      {
        is_split[at(triangle.edges[0])] = 1;
        grows                           = true;
      }
  }
  return is_split;
}

/// One round of bisection on a mesh that grows.
class Bisection
{
public:
  Bisection(const TorusMesh &mesh, const std::vector<char> &is_split)
      : fine(mesh)
      , halves(mesh.edges.size())
  {
    fine.triangles.clear();
    fine.triangles.reserve(2 * mesh.triangles.size());
    for (int e = 0; e < mesh.n_edges(); ++e)
      if (is_split[at(e)])
        split(e);
    for (const TorusTriangle &triangle : mesh.triangles)
      bisect(triangle);
    forget_split_edges();
  }

  TorusMesh fine;

private:
  void split(const int e)
  {
    const TorusEdge edge       = fine.edges[at(e)];
    const Eigen::Vector2d half = 0.5 * edge.vector;
    Halves &its                = halves[at(e)];
    its.midpoint               = fine.n_vertices++;
    its.first                  = fine.n_edges();
    fine.edges.push_back({edge.tail, its.midpoint, half + edge.bulge, 0.25 * edge.bulge});
    its.second = fine.n_edges();
    fine.edges.push_back({its.midpoint, edge.head, half - edge.bulge, 0.25 * edge.bulge});
    const VertexOrigin &tail = fine.origins[at(edge.tail)], &head = fine.origins[at(edge.head)];
    const Eigen::Vector2d from_tail = tail.offset + half + edge.bulge,
                          from_head = head.offset - half + edge.bulge;
    fine.origins.push_back(from_tail.squaredNorm() <= from_head.squaredNorm()
                             ? VertexOrigin{tail.vertex, from_tail}
                             : VertexOrigin{head.vertex, from_head});
  }

  bool is_split(const int e) const
  {
    return at(e) < halves.size() && halves[at(e)].midpoint >= 0;
  }

  void bisect(const TorusTriangle &triangle)
  {
    if (!is_split(triangle.edges[0]))
    {
      fine.triangles.push_back(triangle);
      return;
    }
    // (a, b, c) with m between a and b becomes (c, a, m) and (b, c, m).
    const auto [a, b, c]          = triangle.vertices;
    const Halves &its             = halves[at(triangle.edges[0])];
    const bool runs_ab            = triangle.signs[0] > 0.;
    const Eigen::Vector2d edge_ab = triangle.signs[0] * fine.edges[at(triangle.edges[0])].vector;
    const Eigen::Vector2d edge_bc = triangle.signs[1] * fine.edges[at(triangle.edges[1])].vector;
    const Eigen::Vector2d bulge   = fine.edges[at(triangle.edges[0])].bulge;
    const int spine               = fine.n_edges();
    fine.edges.push_back({its.midpoint, c, 0.5 * edge_ab + edge_bc - bulge});
    TorusTriangle first = triangle, second = triangle;
    first.vertices  = {c, a, its.midpoint};
    first.edges     = {triangle.edges[2], runs_ab ? its.first : its.second, spine};
    first.signs     = {triangle.signs[2], triangle.signs[0], 1.};
    first.corner    = triangle.corner + edge_ab + edge_bc;
    second.vertices = {b, c, its.midpoint};
    second.edges    = {triangle.edges[1], spine, runs_ab ? its.second : its.first};
    second.signs    = {triangle.signs[1], -1., triangle.signs[0]};
    second.corner   = triangle.corner + edge_ab;
    bisect(first);
    bisect(second);
  }

  void forget_split_edges()
  {
    std::vector<int> number(fine.edges.size(), -1);
    int n = 0;
    for (std::size_t e = 0; e < fine.edges.size(); ++e)
      if (!is_split(static_cast<int>(e)))
      {
        number[e]         = n;
        fine.edges[at(n)] = fine.edges[e];
        ++n;
      }
    fine.edges.resize(at(n));
    for (TorusTriangle &triangle : fine.triangles)
      for (int &edge : triangle.edges)
        edge = number[at(edge)];
  }

  std::vector<Halves> halves;
};
} // namespace

TorusMesh bisected(const TorusMesh &mesh, const std::vector<char> &is_marked)
{
  return Bisection(mesh, closure(mesh, is_marked)).fine;
}
} // namespace homespun::homogenization
