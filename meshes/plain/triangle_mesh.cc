// SPDX-License-Identifier: MIT
#include "meshes/plain/triangle_mesh.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/fault_list.h"
#include "meshes/plain/triangle_area.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>
#include <unordered_map>

namespace homespun::meshes
{
namespace
{
std::uint64_t key(const int from, const int to)
{
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32) |
         static_cast<std::uint32_t>(to);
}

std::string at(const TriangleMesh &mesh, const int vertex)
{
  std::ostringstream text;
  text << '(' << mesh.vertices(vertex, 0) << ", " << mesh.vertices(vertex, 1) << ") m";
  return text.str();
}

Place place_of_triangle(const TriangleMesh &mesh, const int t)
{
  return {(mesh.vertices.row(mesh.triangles(t, 0)) + mesh.vertices.row(mesh.triangles(t, 1)) +
           mesh.vertices.row(mesh.triangles(t, 2))) /
            3.,
          t, -1};
}

/// Of each triangle the first one that has the same vertices, in any order: mostly itself.
std::vector<int> first_with_same_vertices(const TriangleMesh &mesh)
{
  struct Sorted
  {
    std::array<int, 3> corners;
    int triangle;
  };
  std::vector<Sorted> all(static_cast<std::size_t>(mesh.n_triangles()));
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    Sorted &its = all[static_cast<std::size_t>(t)];
    its         = {{mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)}, t};
    std::sort(its.corners.begin(), its.corners.end());
  }
  std::sort(all.begin(), all.end(),
            [](const Sorted &a, const Sorted &b)
            { return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle); });
  std::vector<int> first(all.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    first[static_cast<std::size_t>(all[k].triangle)] =
      k > 0 && all[k].corners == all[k - 1].corners
        ? first[static_cast<std::size_t>(all[k - 1].triangle)]
        : all[k].triangle;
  return first;
}
} // namespace

Eigen::VectorXd signed_areas(const TriangleMesh &mesh)
{
  Eigen::VectorXd areas(mesh.n_triangles());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const Eigen::RowVector2d x0    = mesh.vertices.row(mesh.triangles(t, 0));
    const Eigen::RowVector2d edge1 = mesh.vertices.row(mesh.triangles(t, 1)) - x0;
    const Eigen::RowVector2d edge2 = mesh.vertices.row(mesh.triangles(t, 2)) - x0;
    areas(t)                       = 0.5 * (edge1(0) * edge2(1) - edge1(1) * edge2(0));
  }
  return areas;
}

std::vector<std::array<int, 2>> boundary_edges(const TriangleMesh &mesh)
{
  // Where the edges that leave each vertex go, side by side in memory: a hash table of all edges
  // takes ten times as long and as much, which shows in cells of millions of triangles.
  std::vector<std::size_t> first(static_cast<std::size_t>(mesh.n_vertices()) + 1, 0);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      ++first[static_cast<std::size_t>(mesh.triangles(t, k)) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  struct Leaving
  {
    int to, triangle;
  };
  std::vector<Leaving> leaving(3 * static_cast<std::size_t>(mesh.n_triangles()));
  std::vector<std::size_t> end(first.begin(), first.end() - 1); // of those seen so far
  const auto find = [&](const int from, const int to) -> const Leaving *
  {
    const auto v = static_cast<std::size_t>(from);
    for (std::size_t e = first[v]; e < end[v]; ++e)
      if (leaving[e].to == to)
        return &leaving[e];
    return nullptr;
  };
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int from = mesh.triangles(t, k), to = mesh.triangles(t, (k + 1) % 3);
      if (const Leaving *other = find(from, to))
        throw BadInput("the edge from vertex " + std::to_string(from) + " to vertex " +
                       std::to_string(to) + " is traversed the same way by triangles " +
                       std::to_string(other->triangle) + " and " + std::to_string(t) +
                       "; expected one triangle on each side: remove the duplicate triangle or "
                       "turn the inverted one");
      leaving[end[static_cast<std::size_t>(from)]++] = {to, t};
    }
  std::vector<std::array<int, 2>> edges;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int from = mesh.triangles(t, k), to = mesh.triangles(t, (k + 1) % 3);
      if (!find(to, from))
        edges.push_back({from, to});
    }
  return edges;
}

std::vector<std::vector<int>> boundary_loops(const TriangleMesh &mesh)
{
  const std::vector<std::array<int, 2>> edges = boundary_edges(mesh);
  std::unordered_map<int, std::vector<std::size_t>> leaving;
  for (std::size_t e = 0; e < edges.size(); ++e)
    leaving[edges[e][0]].push_back(e);

  // Where loops touch, several edges leave a vertex: the one that turns most to the left, seen from
  // the edge that arrives, keeps the two loops apart on the side of the mesh.
  const auto direction = [&](const std::size_t e) -> Eigen::RowVector2d
  { return mesh.vertices.row(edges[e][1]) - mesh.vertices.row(edges[e][0]); };
  const auto turn = [&](const std::size_t from, const std::size_t to)
  {
    const Eigen::RowVector2d a = direction(from), b = direction(to);
    return std::atan2(a(0) * b(1) - a(1) * b(0), a.dot(b));
  };

  std::vector<char> used(edges.size(), 0);
  std::vector<std::vector<int>> loops;
  for (std::size_t first = 0; first < edges.size(); ++first)
  {
    if (used[first])
      continue;
    std::vector<int> loop;
    std::size_t edge = first;
    while (true)
    {
      used[edge] = 1;
      loop.push_back(edges[edge][0]);
      const std::vector<std::size_t> &candidates = leaving[edges[edge][1]];
      std::size_t next                           = edges.size();
      for (const std::size_t candidate : candidates)
        if (!used[candidate] || candidate == first)
          if (next == edges.size() || turn(edge, candidate) > turn(edge, next))
            next = candidate;
      if (next == edges.size() || next == first)
        break;
      edge = next;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

namespace
{
/// Vertices that are not finite, triangles that name vertices which there are not.
/// @return whether there is none of them
bool check_numbers(const TriangleMesh &mesh, FaultList &faults)
{
  bool usable = true;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!mesh.vertices.row(v).allFinite())
    {
      faults.add("vertices that are not finite",
                 "vertex " + std::to_string(v) + " has coordinates that are not finite numbers");
      usable = false;
    }
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      if (mesh.triangles(t, k) < 0 || mesh.triangles(t, k) >= mesh.n_vertices())
      {
        faults.add("indices out of range", "triangle " + std::to_string(t) + " names vertex " +
                                             std::to_string(mesh.triangles(t, k)) +
                                             "; expected 0 to " +
                                             std::to_string(mesh.n_vertices() - 1));
        usable = false;
      }
  return usable;
}

/// Triangles without area, and inverted ones.
void check_areas(const TriangleMesh &mesh, FaultList &faults)
{
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TriangleArea its = triangle_area<2>(mesh.vertices, mesh.triangles.row(t));
    const auto begin       = [&](std::ostringstream &text) // of faults alone: it takes its time
    { text << "triangle " << t << " near " << at(mesh, mesh.triangles(t, 0)); };
    if (!its.is_there())
    {
      std::ostringstream text;
      begin(text);
      text << " has area " << its.area << " m^2 with a longest edge of " << its.longest_edge
           << " m; expected a proper triangle: merge its vertices or remesh";
      faults.add("triangles without area", text.str(), place_of_triangle(mesh, t));
    }
    else if (its.area < 0.)
    {
      std::ostringstream text;
      begin(text);
      text << " is inverted (area " << its.area
           << " m^2); expected vertices in counter-clockwise order: reverse it, or untangle "
              "the mesh there";
      faults.add("inverted triangles", text.str(), place_of_triangle(mesh, t));
    }
  }
}

/// Triangles at an edge: how many, how many of them from the lower vertex to the higher, the first.
struct Sharing
{
  int n = 0, upwards = 0, first = -1;
};

/// Triangles that are there twice, and edges that are no edges of a surface.
void check_edges(const TriangleMesh &mesh, FaultList &faults)
{
  const std::vector<int> first_with = first_with_same_vertices(mesh);
  std::unordered_map<std::uint64_t, Sharing> sharing;
  sharing.reserve(static_cast<std::size_t>(mesh.n_vertices() + mesh.n_triangles())); // Euler
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const int first   = first_with[static_cast<std::size_t>(t)];
    const bool is_new = first == t;
    if (!is_new)
      faults.add("duplicate triangles",
                 "triangle " + std::to_string(t) + " repeats triangle " + std::to_string(first) +
                   "; expected each once: delete one",
                 place_of_triangle(mesh, t));
    for (int k = 0; k < 3; ++k)
    {
      const int from = mesh.triangles(t, k), to = mesh.triangles(t, (k + 1) % 3);
      Sharing &edge = sharing[key(std::min(from, to), std::max(from, to))];
      edge.first    = edge.n == 0 ? t : edge.first;
      edge.upwards += from < to ? 1 : 0;
      const Place place_of_edge{0.5 * (mesh.vertices.row(from) + mesh.vertices.row(to)), t, -1};
      const auto its_name = [&]()
      {
        return "the edge between vertices " + std::to_string(from) + " and " + std::to_string(to) +
               " near " + at(mesh, from);
      };
      if (++edge.n == 3)
        faults.add("edges with more than two triangles",
                   its_name() +
                     " belongs to more than two triangles; expected one or two: triangles "
                     "overlap there",
                   place_of_edge);
      else if (is_new && edge.n == 2 && edge.upwards != 1)
        faults.add("edges with both triangles on one side",
                   its_name() + " has triangles " + std::to_string(edge.first) + " and " +
                     std::to_string(t) +
                     " on the same side; expected one on each: the mesh folds over itself there, "
                     "untangle it",
                   place_of_edge);
    }
  }
}

void check_vertices(const TriangleMesh &mesh, FaultList &faults)
{
  std::vector<char> is_used(static_cast<std::size_t>(mesh.n_vertices()), 0);
  for (const int v : mesh.triangles.reshaped())
    is_used[static_cast<std::size_t>(v)] = 1;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!is_used[static_cast<std::size_t>(v)])
      faults.add("isolated vertices",
                 "vertex " + std::to_string(v) + " at " + at(mesh, v) +
                   " belongs to no triangle; expected none such: remove it",
                 {mesh.vertices.row(v), -1, v});
}
} // namespace

std::vector<std::string> faults_of(const TriangleMesh &mesh, const std::string &name)
{
  return messages_of(placed_faults_of(mesh, name));
}

std::vector<MeshFault> placed_faults_of(const TriangleMesh &mesh, const std::string &name)
{
  FaultList faults(name);
  if (mesh.n_triangles() == 0)
    faults.add("empty meshes", "no triangle found; expected at least one");
  if (mesh.material.size() != mesh.n_triangles())
    faults.add("sizes", std::to_string(mesh.material.size()) + " material numbers for " +
                          std::to_string(mesh.n_triangles()) + " triangles; expected as many");

  if (!check_numbers(mesh, faults))
    return faults.take_placed();
  check_areas(mesh, faults);
  check_edges(mesh, faults);
  check_vertices(mesh, faults);
  return faults.take_placed();
}
} // namespace homespun::meshes
