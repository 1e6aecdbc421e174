// SPDX-License-Identifier: MIT
#include "homogenization/bracket/holes.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"

#include <cmath>
#include <numeric>

namespace homespun::homogenization
{
using meshes::at;

Rims rims_of(const TorusMesh &mesh)
{
  Rims rims;
  rims.of_vertex.resize(at(mesh.n_vertices));
  rims.of_edge.resize(mesh.edges.size());
  const auto edges_of_rims = rim_edges(mesh);
  // Holes that touch in a vertex share value and gradient of a stress function there, hence the
  // whole affine function.
  std::vector<int> parent(at(mesh.n_vertices));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v)
  {
    while (parent[at(v)] != v)
      v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  for (const auto &[t, k] : edges_of_rims)
  {
    const TorusTriangle &triangle              = mesh.triangles[at(t)];
    parent[at(root(triangle.vertices[at(k)]))] = root(triangle.vertices[at((k + 1) % 3)]);
  }
  std::vector<int> hole_of_root(at(mesh.n_vertices), -1);
  std::vector<Eigen::Vector2d> origins;
  const double tolerance = meshes::image_tolerance * std::sqrt(mesh.lattice.area());
  for (const auto &[t, k] : edges_of_rims)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const auto shape              = triangle.shape(mesh.edges);
    int &hole                     = hole_of_root[at(root(triangle.vertices[at(k)]))];
    if (hole < 0)
    {
      hole = static_cast<int>(origins.size());
      origins.emplace_back(triangle.corner + shape[at(k)]);
    }
    const Eigen::Vector2d &origin           = origins[at(hole)];
    const Eigen::Vector2d ends[2]           = {triangle.corner + shape[at(k)] - origin,
                                               triangle.corner + shape[at((k + 1) % 3)] - origin};
    rims.of_edge[at(triangle.edges[at(k)])] = {hole, 0.5 * (ends[0] + ends[1])};
    for (int end = 0; end < 2; ++end)
    {
      RimPoint &rim = rims.of_vertex[at(triangle.vertices[at((k + end) % 3)])];
      if (rim.hole >= 0 && (rim.position - ends[end]).norm() > tolerance)
        throw meshes::BadInput(
          "a hole of the cell meets an image of itself or of another hole at the outline; expected "
          "holes inside the cell: shift the cell, or fill the hole with a soft phase");
      rim = {hole, ends[end]};
    }
  }
  rims.n_holes = static_cast<int>(origins.size());
  return rims;
}
} // namespace homespun::homogenization
