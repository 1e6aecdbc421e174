// SPDX-License-Identifier: MIT
#include "shell/terms/short_waves.h"

#include "meshes/plain/triangle_mesh.h"
#include "shell/algebra/index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace homespun::shell
{
namespace
{
constexpr double first_zero     = 3.8317 / (2. * M_PI); // of J1(2πr/λ), r/λ
constexpr double rings_per_side = 4.;
constexpr double least_turn     = M_PI / 180.; // per side
/// Of the square of the angles' sums at vertices, over that of the sums without sign: waves have
/// 0.1 to 1, depending on how they run to the mesh, saddles on uneven meshes up to 0.03.
constexpr double least_one_sided = 1. / 16.;
} // namespace

ShortWaves::ShortWaves(const meshes::ClothMesh &mesh)
    : triangles(mesh.triangles)
{
  mean_side = std::sqrt(2. * meshes::signed_areas(mesh.rest).cwiseAbs().mean());
  find_edges(mesh);
  find_neighbours(mesh);
}

void ShortWaves::find_edges(const meshes::ClothMesh &mesh)
{
  std::map<std::array<int, 2>, std::array<int, 2>> sides; // directed, {triangle, opposite corner}
  for (int t = 0; t < mesh.rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      sides[{mesh.rest.triangles(t, (k + 1) % 3), mesh.rest.triangles(t, (k + 2) % 3)}] = {t, k};
  for (const auto &[its, side] : sides)
    if (const auto other = sides.find({its[1], its[0]}); its[0] < its[1] && other != sides.end())
    {
      edges.push_back({{side[0], other->second[0]}, {side[1], other->second[1]}, {}, {}});
      ends.push_back(its);
      lengths.push_back((mesh.rest.vertices.row(its[0]) - mesh.rest.vertices.row(its[1])).norm());
    }
}

void ShortWaves::find_neighbours(const meshes::ClothMesh &mesh)
{
  const auto n = static_cast<std::size_t>(mesh.rest.n_vertices());
  std::vector<std::vector<int>> next(n);
  for (int t = 0; t < mesh.rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      for (const int other : {1, 2})
        next[index(mesh.rest.triangles(t, k))].push_back(mesh.rest.triangles(t, (k + other) % 3));
  // Through edges, so that panels may lie on each other at rest.
  within.resize(n);
  std::vector<int> seen_from(n, -1);
  for (int v = 0; v < static_cast<int>(n); ++v)
  {
    std::vector<Neighbour> &found = within[index(v)];
    found.push_back({v, 0});
    seen_from[index(v)] = v;
    for (std::size_t k = 0; k < found.size(); ++k)
      for (const int u : next[index(found[k].vertex)])
      {
        const double sides =
          (mesh.rest.vertices.row(u) - mesh.rest.vertices.row(v)).norm() / mean_side;
        if (seen_from[index(u)] == v || sides > first_zero * longest)
          continue;
        seen_from[index(u)] = v;
        found.push_back({u, static_cast<int>(rings_per_side * sides * (1. + 1e-9))});
      }
  }
}

/// @param products (rings,n) b_v Σ b_u, u no farther from v than a ring
double ShortWaves::length_around(const int vertex, const Eigen::MatrixXd &products) const
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(products.rows());
  for (const Neighbour &its : within[index(vertex)])
    sum += products.col(its.vertex);
  for (Eigen::Index ring = 0; ring < sum.size(); ++ring)
    if (sum(ring) <= 0.)
      return (static_cast<double>(ring) + 0.5) / rings_per_side / first_zero;
  return std::numeric_limits<double>::infinity();
}

double ShortWaves::shortest(const meshes::SpacePoints &positions) const
{
  const auto n                = static_cast<Eigen::Index>(within.size());
  const Eigen::VectorXd theta = angles_at_edges(edges, triangles, positions);
  Eigen::VectorXd bend = Eigen::VectorXd::Zero(n), unsigned_bend = bend; // angles per side
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const int v : ends[e])
    {
      const double its = 0.5 * lengths[e] / mean_side * theta(static_cast<Eigen::Index>(e));
      bend(v) += its;
      unsigned_bend(v) += std::abs(its);
    }
  const auto n_rings       = static_cast<Eigen::Index>(rings_per_side * first_zero * longest) + 1;
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(n_rings, n);
  for (Eigen::Index v = 0; v < n; ++v)
  {
    for (const Neighbour &its : within[index(v)])
      products(its.ring, v) += bend(v) * bend(its.vertex);
    for (Eigen::Index ring = 1; ring < n_rings; ++ring)
      products(ring, v) += products(ring - 1, v);
  }
  const double mean =
    std::max(bend.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, n)),
             least_turn * least_turn);
  double shortest = std::numeric_limits<double>::infinity();
  for (int v = 0; v < n; ++v)
  {
    double its = 0., without_sign = 0.;
    for (const Neighbour &other : within[index(v)])
    {
      its += bend(other.vertex) * bend(other.vertex);
      without_sign += unsigned_bend(other.vertex) * unsigned_bend(other.vertex);
    }
    if (its >= mean * static_cast<double>(within[index(v)].size()) &&
        its >= least_one_sided * without_sign)
      shortest = std::min(shortest, length_around(v, products));
  }
  return shortest;
}
} // namespace homespun::shell
