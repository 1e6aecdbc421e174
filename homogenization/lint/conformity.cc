// SPDX-License-Identifier: MIT
#include "homogenization/lint/conformity.h"

#include "meshes/plain/cross.h"
#include "meshes/plain/fault_list.h"
#include "meshes/plain/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <unordered_map>

namespace homespun::homogenization
{
using meshes::at;
using meshes::cross;
using meshes::TriangleMesh;
using Vector = Eigen::RowVector2d;

namespace
{
/// Gaps below this part of the edges beside them are none that was drawn.
constexpr double thinnest = 0.01;

/// What lies nearer than this part of an edge lies on it.
constexpr double touching = 1e-6;

/// An edge of the boundary and its triangle, which lies to its left.
struct BoundaryEdge
{
  int from, to, apex = -1, triangle = -1;
};

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

/// Edges by the squares of a grid that they may pass, about one in each.
class EdgeGrid
{
public:
  EdgeGrid(const TriangleMesh &mesh, const std::vector<BoundaryEdge> &edges)
      : low(mesh.vertices.colwise().minCoeff())
  {
    const Vector size = Vector(mesh.vertices.colwise().maxCoeff()) - low;
    width = std::max(size.maxCoeff() / std::sqrt(static_cast<double>(edges.size()) + 1.),
                     std::numeric_limits<double>::min());
    for (std::size_t e = 0; e < edges.size(); ++e)
    {
      const Vector a = mesh.vertices.row(edges[e].from), b = mesh.vertices.row(edges[e].to);
      const double reach = thinnest * (b - a).norm();
      const auto first   = square_of(a.cwiseMin(b).array() - reach),
                 last    = square_of(a.cwiseMax(b).array() + reach);
      for (int i = first[0]; i <= last[0]; ++i)
        for (int j = first[1]; j <= last[1]; ++j)
          edges_in[key(i, j)].push_back(e);
    }
  }

  /// Those near to a point.
  const std::vector<std::size_t> &around(const Vector &x) const
  {
    static const std::vector<std::size_t> none;
    const auto square = square_of(x);
    const auto found  = edges_in.find(key(square[0], square[1]));
    return found == edges_in.end() ? none : found->second;
  }

  const std::unordered_map<long, std::vector<std::size_t>> &squares() const
  {
    return edges_in;
  }

private:
  std::array<int, 2> square_of(const Vector &x) const
  {
    return {static_cast<int>(std::floor((x(0) - low(0)) / width)),
            static_cast<int>(std::floor((x(1) - low(1)) / width))};
  }
  static long key(const int i, const int j)
  {
    return (static_cast<long>(i) << 32) + j;
  }

  Vector low;
  double width;
  std::unordered_map<long, std::vector<std::size_t>> edges_in;
};

bool is_inside(const TriangleMesh &mesh, const int t, const Vector &x)
{
  for (int k = 0; k < 3; ++k)
  {
    const Vector a = mesh.vertices.row(mesh.triangles(t, k)),
                 b = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3));
    if (cross(b - a, x - a) <= 0.)
      return false;
  }
  return true;
}

/// Positive around a part, negative around a hole.
double twice_area(const TriangleMesh &mesh, const std::vector<int> &loop)
{
  double its = 0.;
  for (std::size_t k = 0; k < loop.size(); ++k)
    its += cross(Vector(mesh.vertices.row(loop[k])),
                 Vector(mesh.vertices.row(loop[(k + 1) % loop.size()])));
  return its;
}

const char *const join =
  "expected parts that touch to share their points: join them before meshing "
  "(Gmsh: BooleanFragments, or Coherence), or merge the points that are one "
  "(Gmsh: Coherence Mesh)";

const char *const part =
  "expected triangles side by side: remove one of two parts that lie on each "
  "other, or cut them along each other before meshing (Gmsh: BooleanFragments)";

class Conformity
{
public:
  Conformity(const TriangleMesh &mesh, const std::string &name, const Slits slits,
             const double metres_per_unit)
      : mesh(mesh)
      , slits(slits)
      , metres_per_unit(metres_per_unit)
      , edges(edges_of_boundary(mesh))
      , grid(mesh, edges)
      , faults(name)
  {
  }

  std::vector<meshes::MeshFault> run()
  {
    look_at_vertices();
    look_at_crossings();
    look_at_parts();
    return faults.take_placed();
  }

private:
  Vector x(const int vertex) const
  {
    return mesh.vertices.row(vertex);
  }

  std::string name(const int vertex) const
  {
    std::ostringstream text;
    text.precision(8);
    text << vertex << " at (" << mesh.vertices(vertex, 0) / metres_per_unit << ", "
         << mesh.vertices(vertex, 1) / metres_per_unit << ")";
    return text.str();
  }

  /// Vertices on, near to or beyond an edge that is not theirs.
  void look_at_vertices()
  {
    std::map<int, double> shortest; // edge of the boundary at each of its vertices
    for (const BoundaryEdge &edge : edges)
      for (const int end : {edge.from, edge.to})
      {
        const double length = (x(edge.to) - x(edge.from)).norm();
        const auto place    = shortest.emplace(end, length).first;
        place->second       = std::min(place->second, length);
      }
    std::set<std::array<int, 2>> told; // pairs of vertices
    for (const auto &[vertex, its_shortest] : shortest)
      for (const std::size_t e : grid.around(x(vertex)))
      {
        const BoundaryEdge &edge = edges[e];
        if (vertex == edge.from || vertex == edge.to || vertex == edge.apex)
          continue;
        const Vector a = x(edge.from), along = x(edge.to) - a;
        const double length = along.norm(),
                     where  = std::clamp((x(vertex) - a).dot(along) / (length * length), 0., 1.);
        const double gap    = (x(vertex) - a - where * along).norm(),
                     near   = thinnest * std::min(length, its_shortest);
        if (gap >= near)
          continue;
        const double left = cross(along, x(vertex) - a) / length;
        if (left > touching * length)
        {
          // Beyond the edge: within its triangle, or on the far side of a thin strip.
          if (is_inside(mesh, edge.triangle, x(vertex)))
            tell_overlap(vertex, edge);
          continue;
        }
        if (slits == Slits::real)
          continue;
        const int end = where < 0.5 ? edge.from : edge.to;
        if ((x(vertex) - x(end)).norm() < near)
        {
          if (told.insert({std::min(vertex, end), std::max(vertex, end)}).second)
            tell_pair(vertex, end);
        }
        else
          tell_side(vertex, edge, gap, length);
      }
  }

  void tell_overlap(const int vertex, const BoundaryEdge &edge)
  {
    faults.add("overlaps",
               "vertex " + name(vertex) + " lies inside triangle " + std::to_string(edge.triangle) +
                 " of which it is no corner: triangles overlap there; " + part,
               {x(vertex), edge.triangle, vertex});
  }

  void tell_pair(const int vertex, const int other)
  {
    std::ostringstream what;
    what << "vertices " << name(std::min(vertex, other)) << " and " << name(std::max(vertex, other))
         << (x(vertex) == x(other) ? " coincide" : " nearly coincide")
         << " without being one: parts that lie side by side there are not joined; " << join;
    faults.add("pairs of vertices that coincide", what.str(), {x(vertex), -1, vertex});
  }

  void tell_side(const int vertex, const BoundaryEdge &edge, const double gap, const double length)
  {
    std::ostringstream what;
    what.precision(3);
    what << "vertex " << name(vertex);
    if (gap < touching * length)
      what << " lies on";
    else
      what << " lies " << gap / metres_per_unit << " beside";
    what << " the side from vertex " << name(edge.from) << " to vertex " << name(edge.to)
         << " of triangle " << edge.triangle << " of which it is no corner: "
         << (gap < touching * length ? "a T-junction, which finite elements take for a crack"
                                     : "a slit that is thinner than a hundredth of its edges")
         << "; " << join << "; a slit that is meant asks for `Slits = real`";
    faults.add(gap < touching * length ? "T-junctions" : "vertices at slits", what.str(),
               {x(vertex), edge.triangle, vertex});
  }

  /// Edges of the boundary that cross, where no vertex has told it.
  void look_at_crossings()
  {
    std::set<std::array<std::size_t, 2>> crossing;
    for (const auto &[square, near] : grid.squares())
      for (std::size_t i = 0; i < near.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
        {
          const BoundaryEdge &one = edges[near[i]], &other = edges[near[j]];
          if (one.from == other.from || one.from == other.to || one.to == other.from ||
              one.to == other.to)
            continue;
          const Vector a = x(one.from), b = x(one.to), c = x(other.from), d = x(other.to);
          const double scale = touching * (b - a).norm() * (d - c).norm();
          const auto apart   = [scale](const double p, const double q)
          { return (p > scale && q < -scale) || (p < -scale && q > scale); };
          if (apart(cross(b - a, c - a), cross(b - a, d - a)) &&
              apart(cross(d - c, a - c), cross(d - c, b - c)))
            crossing.insert({std::min(near[i], near[j]), std::max(near[i], near[j])});
        }
    for (const auto &[first, second] : crossing)
    {
      const BoundaryEdge &one = edges[first], &other = edges[second];
      faults.add("overlaps",
                 "the side from vertex " + name(one.from) + " to vertex " + name(one.to) +
                   " of triangle " + std::to_string(one.triangle) +
                   " crosses the one from vertex " + name(other.from) + " to vertex " +
                   name(other.to) + " of triangle " + std::to_string(other.triangle) +
                   ": triangles overlap there; " + part,
                 {0.5 * (x(one.from) + x(one.to)), one.triangle, -1});
    }
  }

  /// Parts on top of others.
  void look_at_parts()
  {
    const auto loops = meshes::boundary_loops(mesh);
    if (loops.size() == 1)
      return;
    std::map<std::array<int, 2>, int> triangle_at;
    for (const BoundaryEdge &edge : edges)
      triangle_at[{edge.from, edge.to}] = edge.triangle;
    std::size_t n_parts = 0;
    for (const std::vector<int> &loop : loops)
      if (twice_area(mesh, loop) > 0. && ++n_parts <= 50)
        look_below(triangle_at.at({loop[0], loop[1]}));
  }

  /// Whether a triangle of a part lies on one of another part.
  void look_below(const int t)
  {
    const Vector centre =
      (x(mesh.triangles(t, 0)) + x(mesh.triangles(t, 1)) + x(mesh.triangles(t, 2))) / 3.;
    for (int other = 0; other < mesh.n_triangles(); ++other)
      if (other != t && is_inside(mesh, other, centre))
      {
        faults.add("overlaps",
                   "triangle " + std::to_string(t) + " lies on triangle " + std::to_string(other) +
                     ": parts overlap there; " + part,
                   {centre, t, -1});
        return;
      }
  }

  const TriangleMesh &mesh;
  const Slits slits;
  const double metres_per_unit;
  const std::vector<BoundaryEdge> edges;
  const EdgeGrid grid;
  meshes::FaultList faults;
};
} // namespace

std::vector<meshes::MeshFault> conformity_faults(const TriangleMesh &mesh, const std::string &name,
                                                 const Slits slits, const double metres_per_unit)
{
  return Conformity(mesh, name, slits, metres_per_unit).run();
}

std::vector<Finding> lint_missing_triangles(const TriangleMesh &mesh, const double metres_per_unit)
{
  std::vector<Finding> findings;
  for (const std::vector<int> &loop : meshes::boundary_loops(mesh))
  {
    if (loop.size() != 3 || twice_area(mesh, loop) > 0.)
      continue;
    const Vector centre =
      (mesh.vertices.row(loop[0]) + mesh.vertices.row(loop[1]) + mesh.vertices.row(loop[2])) / 3.;
    std::ostringstream what;
    what << "a hole at (" << centre / metres_per_unit
         << ") in the mesh's unit has the size of a single triangle";
    findings.push_back(
      {Severity::warning,
       "missing triangle",
       what.str(),
       "expected holes of more edges: add the triangle where it is missing, or leave "
       "it where the hole is meant",
       {centre, -1, loop[0]}});
  }
  return findings;
}
} // namespace homespun::homogenization
