// SPDX-License-Identifier: MIT
#include "homogenization/lint/conformity.h"

#include "homogenization/lint/edge_grid.h"
#include "meshes/plain/cross.h"
#include "meshes/plain/fault_list.h"
#include "meshes/plain/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

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

/// Across the sides of a cell gaps below this part are edges that were meant to match.
constexpr double thinnest_across = 0.5;

/// What lies nearer than this part of an edge lies on it.
constexpr double touching = 1e-6;

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

/// Copies of a cell side by side.
struct Copies
{
  std::vector<int> of_triangle; ///< which copy it is of; triangles are numbered copy after copy
  std::vector<int> vertex;      ///< of the drawing
  const TriangleMesh *drawn;
};

class Conformity
{
public:
  Conformity(const TriangleMesh &mesh, const std::string &name, const Slits slits,
             const double metres_per_unit, const Copies *const copies = nullptr)
      : mesh(mesh)
      , slits(slits)
      , metres_per_unit(metres_per_unit)
      , copies(copies)
      , edges(edges_of_boundary(mesh))
      , grid(mesh, edges, copies ? thinnest_across : thinnest)
      , faults(name)
  {
    for (const BoundaryEdge &edge : edges)
      for (const int end : {edge.from, edge.to})
        if (copies)
          copies_at[end].insert(copies->of_triangle[at(edge.triangle)]);
  }

  std::vector<meshes::MeshFault> run()
  {
    look_at_vertices();
    look_at_crossings();
    if (!copies)
      look_at_parts();
    return faults.take_placed();
  }

private:
  Vector x(const int vertex) const
  {
    return mesh.vertices.row(vertex);
  }

  /// Whether a vertex and an edge belong to different copies of the cell alone.
  bool is_across(const int vertex, const BoundaryEdge &edge) const
  {
    return copies_at.at(vertex).count(copies->of_triangle[at(edge.triangle)]) == 0;
  }

  /// Where a vertex is drawn.
  meshes::Place place_of(const int vertex, const int triangle = -1) const
  {
    if (!copies)
      return {x(vertex), triangle, vertex};
    const int drawn = copies->vertex[at(vertex)];
    return {copies->drawn->vertices.row(drawn), -1, drawn};
  }

  std::string name(const int vertex) const
  {
    const meshes::Place place = place_of(vertex);
    std::ostringstream text;
    text.precision(8);
    text << place.vertex << " at (" << place.point(0) / metres_per_unit << ", "
         << place.point(1) / metres_per_unit << ")";
    return text.str();
  }

  std::string name_of_triangle(const int t) const
  {
    return std::to_string(copies ? t % copies->drawn->n_triangles() : t);
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
        if (vertex == edge.from || vertex == edge.to || vertex == edge.apex ||
            (copies && !is_across(vertex, edge)))
          continue;
        const Vector a = x(edge.from), along = x(edge.to) - a;
        const double length = along.norm(),
                     where  = std::clamp((x(vertex) - a).dot(along) / (length * length), 0., 1.);
        const double gap    = (x(vertex) - a - where * along).norm(),
                     near = (copies ? thinnest_across : thinnest) * std::min(length, its_shortest);
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
        if (copies)
        {
          tell_across(vertex, edge, gap);
          continue;
        }
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

  void tell_across(const int vertex, const BoundaryEdge &edge, const double gap)
  {
    std::ostringstream what;
    what.precision(3);
    what << "opposite sides are not meshed alike: vertex " << name(vertex) << " lies "
         << gap / metres_per_unit << " beside the edge from vertex " << name(edge.from)
         << " to vertex " << name(edge.to)
         << " of the opposite side, less than half of an edge, and is not joined to it; expected "
            "both sides to have the same points there (Gmsh: Periodic Curve {right} = {left} "
            "Translate {dx, dy, 0};), or `Slits = real` where a slit is meant";
    faults.add("places where opposite sides are not meshed alike", what.str(), place_of(vertex));
  }

  void tell_overlap(const int vertex, const BoundaryEdge &edge)
  {
    faults.add("overlaps",
               "vertex " + name(vertex) + " lies inside triangle " +
                 name_of_triangle(edge.triangle) +
                 " of which it is no corner: triangles overlap there; " + part,
               place_of(vertex, edge.triangle));
  }

  void tell_pair(const int vertex, const int other)
  {
    std::ostringstream what;
    what << "vertices " << name(std::min(vertex, other)) << " and " << name(std::max(vertex, other))
         << (x(vertex) == x(other) ? " coincide" : " nearly coincide")
         << " without being one: parts that lie side by side there are not joined; " << join;
    faults.add("pairs of vertices that coincide", what.str(), place_of(vertex));
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
               place_of(vertex, edge.triangle));
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
              one.to == other.to ||
              (copies &&
               copies->of_triangle[at(one.triangle)] == copies->of_triangle[at(other.triangle)]))
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
                   " of triangle " + name_of_triangle(one.triangle) +
                   " crosses the one from vertex " + name(other.from) + " to vertex " +
                   name(other.to) + " of triangle " + name_of_triangle(other.triangle) +
                   ": triangles overlap there; " + part,
                 place_of(one.from, one.triangle));
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
  const Copies *copies; ///< null: the mesh is the drawing
  const std::vector<BoundaryEdge> edges;
  const EdgeGrid grid;
  std::map<int, std::set<int>> copies_at; ///< of the edges of the boundary at a vertex
  meshes::FaultList faults;
};
} // namespace

std::vector<meshes::MeshFault> conformity_faults(const TriangleMesh &mesh, const std::string &name,
                                                 const Slits slits, const double metres_per_unit)
{
  return Conformity(mesh, name, slits, metres_per_unit).run();
}

std::vector<meshes::MeshFault> conformity_faults_across(const LatticeTriangles &glued,
                                                        const TriangleMesh &drawn,
                                                        const std::string &name, const Slits slits,
                                                        const double metres_per_unit)
{
  Copies copies{{}, {}, &drawn};
  TriangleMesh four;
  four.triangles.resize(4 * drawn.n_triangles(), 3);
  std::map<std::array<int, 3>, int> vertex_of;
  std::vector<Vector> points;
  for (int copy = 0; copy < 4; ++copy)
    for (int t = 0; t < drawn.n_triangles(); ++t)
    {
      copies.of_triangle.push_back(copy);
      for (int k = 0; k < 3; ++k)
      {
        const LatticeCorner &corner     = glued.triangles[at(t)].corners[at(k)];
        const Eigen::RowVector2i offset = corner.offset + Eigen::RowVector2i(copy % 2, copy / 2);
        const std::array<int, 3> key    = {corner.vertex, offset(0), offset(1)};
        const auto [place, is_new]      = vertex_of.emplace(key, static_cast<int>(points.size()));
        if (is_new)
        {
          points.emplace_back(glued.at({corner.vertex, offset}) * glued.lattice.vectors);
          copies.vertex.push_back(drawn.triangles(t, k));
        }
        four.triangles(copy * drawn.n_triangles() + t, k) = place->second;
      }
    }
  four.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t p = 0; p < points.size(); ++p)
    four.vertices.row(static_cast<Eigen::Index>(p)) = points[p];
  four.material.setZero(four.triangles.rows());
  return Conformity(four, name, slits, metres_per_unit, &copies).run();
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
