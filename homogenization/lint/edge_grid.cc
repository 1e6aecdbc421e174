// SPDX-License-Identifier: MIT
#include "homogenization/lint/edge_grid.h"

#include "meshes/plain/index.h"

#include <cmath>
#include <limits>
#include <map>

namespace homespun::homogenization
{
using meshes::at;
using meshes::TriangleMesh;
using Vector = Eigen::RowVector2d;

std::vector<BoundaryEdge> edges_of_boundary(const TriangleMesh &mesh)
{
  std::vector<BoundaryEdge> edges;
  std::map<std::array<int, 2>, std::size_t> number;
  std::vector<char> is_on_boundary(at(mesh.n_vertices()), 0);
  for (const std::array<int, 2> &edge : meshes::boundary_edges(mesh))
  {
    number[edge] = edges.size();
    edges.push_back({edge[0], edge[1]});
    is_on_boundary[at(edge[0])] = is_on_boundary[at(edge[1])] = 1;
  }
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int from = mesh.triangles(t, k), to = mesh.triangles(t, (k + 1) % 3);
      if (!is_on_boundary[at(from)] || !is_on_boundary[at(to)])
        continue;
      if (const auto edge = number.find({from, to}); edge != number.end())
      {
        edges[edge->second].apex     = mesh.triangles(t, (k + 2) % 3);
        edges[edge->second].triangle = t;
      }
    }
  return edges;
}

namespace
{
long key(const int i, const int j)
{
  return i * (1L << 32) + j;
}
} // namespace

EdgeGrid::EdgeGrid(const TriangleMesh &mesh, const std::vector<BoundaryEdge> &edges,
                   const double near)
    : low(mesh.vertices.colwise().minCoeff())
{
  const Vector size = Vector(mesh.vertices.colwise().maxCoeff()) - low;
  width             = std::max(size.maxCoeff() / std::sqrt(static_cast<double>(edges.size()) + 1.),
                               std::numeric_limits<double>::min());
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    const Vector a = mesh.vertices.row(edges[e].from), b = mesh.vertices.row(edges[e].to);
    const double reach = near * (b - a).norm();
    const auto first   = square_of(a.cwiseMin(b).array() - reach),
               last    = square_of(a.cwiseMax(b).array() + reach);
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j)
        edges_in[key(i, j)].push_back(e);
  }
}


const std::vector<std::size_t> &EdgeGrid::around(const Vector &x) const
{
  static const std::vector<std::size_t> none;
  const auto square = square_of(x);
  const auto found  = edges_in.find(key(square[0], square[1]));
  return found == edges_in.end() ? none : found->second;
}


std::array<int, 2> EdgeGrid::square_of(const Vector &x) const
{
  return {static_cast<int>(std::floor((x(0) - low(0)) / width)),
          static_cast<int>(std::floor((x(1) - low(1)) / width))};
}
} // namespace homespun::homogenization
