// SPDX-License-Identifier: MIT
#include "localization/coarse_surface.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace homespun::localization
{
namespace
{
/// Neighbours are taken one edge farther where the smallest pivot of their fit is below this part
/// of the largest, if that helps; below the second there is no fit.
constexpr double sound_fit = 0.02, any_fit = 1e-5;
constexpr int most_rings = 3;

/// Vertices within so many edges of one, itself not among them, in their order.
std::vector<int> ring_of(const int vertex, const int n_edges,
                         const std::vector<std::vector<int>> &adjacent)
{
  std::set<int> found = {vertex};
  for (int k = 0; k < n_edges; ++k)
    for (const int v : std::vector<int>(found.begin(), found.end()))
      found.insert(adjacent[static_cast<std::size_t>(v)].begin(),
                   adjacent[static_cast<std::size_t>(v)].end());
  found.erase(vertex);
  return {found.begin(), found.end()};
}

/// How many triangles have each edge.
std::map<std::array<int, 2>, int> edges_of(const meshes::Triangles &triangles,
                                           const std::vector<int> &name_of_vertex)
{
  std::map<std::array<int, 2>, int> edges;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = name_of_vertex[static_cast<std::size_t>(triangles(t, k))],
                b = name_of_vertex[static_cast<std::size_t>(triangles(t, (k + 1) % 3))];
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  return edges;
}
} // namespace

CoarseSurface::CoarseSurface(const meshes::TriangleMesh &rest,
                             const std::vector<int> &space_of_rest)
    : mesh(rest)
    , is_sewn(static_cast<std::size_t>(rest.n_triangles()), {false, false, false})
    , first(1, 0)
    , rows(Values::Zero(rest.n_vertices(), n_components))
{
  std::vector<std::vector<int>> adjacent(static_cast<std::size_t>(rest.n_vertices()));
  for (int t = 0; t < rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      for (const int step : {1, 2})
        adjacent[static_cast<std::size_t>(rest.triangles(t, k))].push_back(
          rest.triangles(t, (k + step) % 3));
  for (int v = 0; v < rest.n_vertices(); ++v)
    add_vertex(v, adjacent);
  if (!space_of_rest.empty())
    find_seams(space_of_rest);
}

void CoarseSurface::add_vertex(const int vertex, const std::vector<std::vector<int>> &adjacent)
{
  const auto begin = neighbours.size();
  bool is_found    = false;
  for (const double tolerance : {sound_fit, any_fit})
    for (int n_edges = 1; n_edges <= most_rings && !is_found; ++n_edges)
      is_found = fit(vertex, ring_of(vertex, n_edges, adjacent), 5, tolerance);
  if (!is_found)
    fit(vertex, ring_of(vertex, 1, adjacent), 2, any_fit);
  first.push_back(static_cast<int>(neighbours.size()));
  double largest = 0.;
  for (std::size_t k = begin; k < neighbours.size(); ++k)
    largest = std::max(
      largest, (mesh.vertices.row(neighbours[k].vertex) - mesh.vertices.row(vertex)).squaredNorm());
  reach.push_back(largest);
}

/// Adds the neighbours of a vertex where they determine its derivatives.
/// @param n_terms 5: a quadric; 2: a plane
bool CoarseSurface::fit(const int vertex, std::vector<int> ring, const int n_terms,
                        const double tolerance)
{
  // Round the tip of a slit the other side of a vertex lies where it does, and tells no slope.
  ring.erase(std::remove_if(ring.begin(), ring.end(),
                            [&](const int v)
                            { return mesh.vertices.row(v) == mesh.vertices.row(vertex); }),
             ring.end());
  const auto n = static_cast<Eigen::Index>(ring.size());
  meshes::Points d(n, 2);
  for (Eigen::Index k = 0; k < n; ++k)
    d.row(k) = mesh.vertices.row(ring[static_cast<std::size_t>(k)]) - mesh.vertices.row(vertex);
  const Eigen::ArrayXd d1 = d.col(0), d2 = d.col(1),
                       weights = (d1.square() + d2.square()).inverse();
  Eigen::MatrixXd basis(n, 5);
  basis << d1, d2, 0.5 * d1.square(), 0.5 * d2.square(), 0.5 * d1 * d2;
  basis.array().colwise() *= weights;
  basis.conservativeResize(n, n_terms);
  const Eigen::RowVectorXd norms = basis.colwise().norm();
  if (n < n_terms || !(norms.minCoeff() > 0.))
    return false;
  basis.array().rowwise() /= norms.array();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(basis);
  const auto pivots = solver.matrixR().diagonal().cwiseAbs();
  if (!(pivots(n_terms - 1) > tolerance * pivots(0)))
    return false;
  const Eigen::MatrixXd shares = norms.cwiseInverse().transpose().asDiagonal() *
                                 solver.solve(Eigen::MatrixXd(weights.matrix().asDiagonal()));
  for (Eigen::Index k = 0; k < n; ++k)
  {
    Neighbour next = {ring[static_cast<std::size_t>(k)], {}};
    for (Eigen::Index c = 0; c < n_terms; ++c)
      next.share[static_cast<std::size_t>(c)] = shares(c, k);
    neighbours.push_back(next);
  }
  return true;
}

void CoarseSurface::find_seams(const std::vector<int> &space_of_rest)
{
  std::vector<int> own(space_of_rest.size());
  std::map<int, std::vector<int>> all;
  for (std::size_t v = 0; v < own.size(); ++v)
  {
    own[v] = static_cast<int>(v);
    all[space_of_rest[v]].push_back(own[v]);
  }
  for (const auto &[space, of_rest] : all)
    if (of_rest.size() > 1)
      copies.push_back(of_rest);
  const auto at_rest  = edges_of(mesh.triangles, own),
             in_space = edges_of(mesh.triangles, space_of_rest);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = mesh.triangles(t, (k + 1) % 3), b = mesh.triangles(t, (k + 2) % 3),
                c = space_of_rest[static_cast<std::size_t>(a)],
                d = space_of_rest[static_cast<std::size_t>(b)];
      is_sewn[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)] =
        at_rest.at({std::min(a, b), std::max(a, b)}) <
        in_space.at({std::min(c, d), std::max(c, d)});
    }
}

const CoarseSurface::Values &CoarseSurface::values(const PositionsOf<3> current) const
{
  const double *const __restrict x = current.data();
  const double rounding            = 64. * std::numeric_limits<double>::epsilon() *
                          (current.size() > 0 ? current.cwiseAbs().maxCoeff() : 0.);
  bent = false;
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
  {
    double sums[3][8] = {};
    for (int k = first[v]; k < first[v + 1]; ++k)
    {
      const Neighbour &next = neighbours[static_cast<std::size_t>(k)];
      for (std::size_t i = 0; i < 3; ++i)
      {
        const double difference = x[3 * static_cast<std::size_t>(next.vertex) + i] - x[3 * v + i];
        for (std::size_t c = 0; c < 8; ++c)
          sums[i][c] += difference * next.share[c];
      }
    }
    const auto derivative = [&](const int c)
    { return Eigen::RowVector3d(sums[0][c], sums[1][c], sums[2][c]); };
    const Eigen::RowVector3d f1 = derivative(0), f2 = derivative(1), cross = f1.cross(f2);
    const double J = cross.norm();
    auto row       = rows.row(static_cast<Eigen::Index>(v));
    row.setZero();
    if (!(J > 1e-14 * (f1.squaredNorm() + f2.squaredNorm())))
      continue;
    const Eigen::RowVector3d normal = cross / J;
    row.segment<3>(3)               = normal;
    for (int a = 0; a < 3; ++a)
      row(a) = normal.dot(derivative(2 + a));
    if (row.head<3>().cwiseAbs().maxCoeff() * reach[v] <= rounding)
      row.head<3>().setZero();
    else
      bent = true;
  }
  for (const std::vector<int> &of_rest : copies)
  {
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    for (const int v : of_rest)
      mean += rows.row(v).segment<3>(3);
    for (const int v : of_rest)
      rows.row(v).segment<3>(3) = mean.normalized();
  }
  return rows;
}

Eigen::RowVector3d CoarseSurface::quadric(const int triangle, const Eigen::Vector3d &weights) const
{
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (int k = 0; k < 3; ++k)
  {
    if (is_sewn[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(k)])
      continue;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Eigen::RowVector2d edge = mesh.vertices.row(mesh.triangles(triangle, j)) -
                                    mesh.vertices.row(mesh.triangles(triangle, i));
    sum -= 0.5 * weights(i) * weights(j) *
           Eigen::RowVector3d(edge(0) * edge(0), edge(1) * edge(1), edge(0) * edge(1));
  }
  return sum;
}
} // namespace homespun::localization
