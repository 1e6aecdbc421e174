// SPDX-License-Identifier: MIT
#include "homogenization/bracket/holes.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"

#include <cmath>

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
  // whole affine function: they are one.
  // A rim is walked along its edges, as it goes on beyond a side that cuts its hole.
  struct Step
  {
    int to, edge;
    Eigen::Vector2d vector;
  };
  std::vector<std::vector<Step>> steps_from(at(mesh.n_vertices));
  for (const auto &[t, k] : edges_of_rims)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const auto shape              = triangle.shape(mesh.edges);
    const Eigen::Vector2d vector  = shape[at((k + 1) % 3)] - shape[at(k)];
    const int from = triangle.vertices[at(k)], to = triangle.vertices[at((k + 1) % 3)];
    steps_from[at(from)].push_back({to, triangle.edges[at(k)], vector});
    steps_from[at(to)].push_back({from, triangle.edges[at(k)], -vector});
  }
  const double tolerance = meshes::image_tolerance * std::sqrt(mesh.lattice.area());
  for (const auto &[t, k] : edges_of_rims)
  {
    const int first = mesh.triangles[at(t)].vertices[at(k)];
    if (rims.of_vertex[at(first)].hole >= 0)
      continue;
    rims.of_vertex[at(first)] = {rims.n_holes, Eigen::Vector2d::Zero()};
    for (std::vector<int> left = {first}; !left.empty();)
    {
      const int from = left.back();
      left.pop_back();
      const Eigen::Vector2d here = rims.of_vertex[at(from)].position;
      for (const Step &step : steps_from[at(from)])
      {
        RimPoint &there = rims.of_vertex[at(step.to)];
        if (there.hole < 0)
        {
          there = {rims.n_holes, here + step.vector};
          left.push_back(step.to);
        }
        else if ((there.position - here - step.vector).norm() > tolerance)
          throw meshes::BadInput(
            "a hole of the cell meets an image of itself; expected holes that end: mesh what "
            "connects the cloth across it, or fill the hole with a soft phase");
        rims.of_edge[at(step.edge)] = {rims.n_holes, here + 0.5 * step.vector};
      }
    }
    ++rims.n_holes;
  }
  return rims;
}
} // namespace homespun::homogenization
