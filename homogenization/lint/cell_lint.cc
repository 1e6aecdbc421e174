// SPDX-License-Identifier: MIT
#include "homogenization/lint/cell_lint.h"

#include "homogenization/lint/mechanisms.h"
#include "meshes/plain/index.h"
#include "meshes/plain/vertex_images.h"

#include <Eigen/Geometry>

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
using meshes::Lattice;
using meshes::Place;
using meshes::TriangleMesh;

namespace
{
/// The P1 stiffness of a triangle grows as one over the sine of its smallest angle: eleven times
/// here.
constexpr double smallest_angle = 5.; // [deg]

/// Of one kind no more than this many are told one by one.
constexpr int most_of_a_kind = 3;

/// Where something is, in the unit of the mesh file.
std::string place_text(const Eigen::RowVector2d &point, const double metres_per_unit)
{
  std::ostringstream text;
  text.precision(6);
  text << " at (" << point(0) / metres_per_unit << ", " << point(1) / metres_per_unit
       << ") in the mesh's unit";
  return text.str();
}

Place place_of(const TriangleMesh &mesh, const int t)
{
  return {(mesh.vertices.row(mesh.triangles(t, 0)) + mesh.vertices.row(mesh.triangles(t, 1)) +
           mesh.vertices.row(mesh.triangles(t, 2))) /
            3.,
          t, -1};
}

double angle_at(const TriangleMesh &mesh, const int t, const int k)
{
  const Eigen::RowVector2d x = mesh.vertices.row(mesh.triangles(t, k));
  const Eigen::RowVector2d a = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3)) - x;
  const Eigen::RowVector2d b = mesh.vertices.row(mesh.triangles(t, (k + 2) % 3)) - x;
  return std::atan2(std::abs(a(0) * b(1) - a(1) * b(0)), a.dot(b)) * 180. / M_PI;
}

} // namespace

std::vector<Finding> lint_slivers(const TriangleMesh &mesh, const double metres_per_unit)
{
  int n = 0, worst = -1;
  double least = smallest_angle;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const double angle =
      std::min({angle_at(mesh, t, 0), angle_at(mesh, t, 1), angle_at(mesh, t, 2)});
    n += angle < smallest_angle ? 1 : 0;
    if (angle < least)
    {
      least = angle;
      worst = t;
    }
  }
  if (worst < 0)
    return {};
  std::ostringstream what, remedy;
  what << n << (n == 1 ? " sliver" : " slivers") << ": triangle " << worst
       << place_text(place_of(mesh, worst).point, metres_per_unit) << " has an angle of " << least
       << " degrees";
  remedy << "expected at least " << smallest_angle
         << ", below which solvers slow down and fields are wrong there: remesh, or merge points "
            "that nearly coincide";
  return {{Severity::warning, "sliver", what.str(), remedy.str(), place_of(mesh, worst)}};
}

std::vector<Finding> lint_mechanisms(const TriangleMesh &mesh, const Lattice &lattice,
                                     const double metres_per_unit)
{
  std::vector<Finding> findings;
  const Mechanisms found = find_mechanisms(mesh, lattice);
  int n_free             = 0;
  for (const MeshPart &part : found.parts)
  {
    if (!part.is_free || ++n_free > most_of_a_kind)
      continue;
    std::ostringstream what;
    what << "a part of " << part.n_triangles
         << (part.n_triangles == 1 ? " triangle, " : " triangles, ")
         << 100. * part.area / lattice.area() << " % of the cell,"
         << place_text(part.place.point, metres_per_unit);
    if (part.n_joints == 0)
      what << " floats: nothing holds it";
    else if (part.n_joints == 1)
      what << " hangs on a single vertex and turns freely";
    else
      what << " moves freely on the " << part.n_joints << " vertices that hold it";
    findings.push_back({Severity::error, part.n_joints == 0 ? "floating part" : "mechanism",
                        what.str(),
                        "expected every part to be connected along edges: join it to the rest so "
                        "that they share the points between them (Gmsh: BooleanFragments), fill "
                        "the void with a soft phase, or remove the part",
                        part.place});
  }
  if (n_free > most_of_a_kind)
    findings.push_back(
      {Severity::error,
       "floating part",
       "and " + std::to_string(n_free - most_of_a_kind) + " more parts that move freely",
       "",
       {}});
  if (found.free_strains.cols() > 0)
  {
    std::ostringstream what;
    what.precision(3);
    what << "nothing resists the macro strain (e11, e22, gamma12) = ("
         << found.free_strains.col(0).transpose() << "): C^H would be singular";
    if (found.parts[0].n_periods < 2)
      what << ", for the largest part is connected with its own images across "
           << found.parts[0].n_periods << " of 2 periods";
    findings.push_back(
      {Severity::error, "singular stiffness", what.str(),
       "expected a cell that is connected along edges across both lattice vectors: mesh the "
       "connection, or fill the void with a soft phase",
       found.parts[0].place});
  }
  if (!found.is_determined)
    findings.push_back(
      {Severity::error, "mechanism",
       "the mesh falls into " + std::to_string(found.parts.size()) +
         " parts that share no edge, more than the " + std::to_string(most_parts) +
         " of which free motions are looked for: whether they hold one another is not known",
       "expected parts to be connected along edges: widen the bridges, or join parts that lie "
       "side by side (Gmsh: BooleanFragments, or Coherence)",
       found.parts[1].place});
  int n_hinges = 0;
  for (const int vertex : found.hinges)
    if (++n_hinges <= most_of_a_kind)
      findings.push_back(
        {Severity::warning,
         "hinge",
         "parts meet in nothing but vertex " + std::to_string(vertex) +
           place_text(mesh.vertices.row(vertex), metres_per_unit) +
           ", a hinge: a point has no stiffness, so that results follow the mesh width there",
         "expected parts to meet along edges: widen the bridge, or leave a gap",
         {mesh.vertices.row(vertex), -1, vertex}});
  if (n_hinges > most_of_a_kind)
    findings.push_back({Severity::warning,
                        "hinge",
                        "and " + std::to_string(n_hinges - most_of_a_kind) + " more hinges",
                        "",
                        {}});
  return findings;
}

namespace
{
/// Vertices as their images: the sides of the cell are no boundary of a part.
std::vector<int> vertices_of_torus(const UnitCell &cell)
{
  return meshes::match_images(cell.mesh, meshes::sides_of(cell.mesh, cell.lattice).vertices,
                              cell.lattice)
    .representative;
}

/// The edges of a cell on the torus, and which of them lie within a group.
struct GroupEdges
{
  struct Edge
  {
    int first = -1, second = -1; ///< triangles
    bool is_inside = false;      ///< of one group
  };

  explicit GroupEdges(const UnitCell &cell)
      : mesh(cell.mesh)
      , torus(vertices_of_torus(cell))
      , group_of_phase(cell.group_of_phase())
      , on_boundary(static_cast<std::size_t>(mesh.n_vertices()), 0)
  {
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
      {
        Edge &edge                                  = edges[key(t, k)];
        (edge.first < 0 ? edge.first : edge.second) = t;
      }
    for (auto &[its_key, edge] : edges)
    {
      edge.is_inside = edge.second >= 0 && group(edge.first) == group(edge.second);
      if (!edge.is_inside)
        for (const long end : {its_key / mesh.n_vertices(), its_key % mesh.n_vertices()})
          on_boundary[static_cast<std::size_t>(end)] = 1;
    }
  }

  int vertex(const int t, const int k) const
  {
    return torus[static_cast<std::size_t>(mesh.triangles(t, k % 3))];
  }
  int group(const int t) const
  {
    return group_of_phase[static_cast<std::size_t>(mesh.material(t))];
  }
  /// Of side k of triangle t.
  long key(const int t, const int k) const
  {
    const int a = vertex(t, k), b = vertex(t, k + 1);
    return static_cast<long>(std::min(a, b)) * mesh.n_vertices() + std::max(a, b);
  }

  /// Whether an edge lies between two triangles side by side whose other boundaries have no vertex
  /// in common: both banks of a strip. In a corner they would have one in common.
  bool is_across_strip(const long its_key, const Edge &edge) const
  {
    if (!edge.is_inside || !on_boundary[static_cast<std::size_t>(its_key / mesh.n_vertices())] ||
        !on_boundary[static_cast<std::size_t>(its_key % mesh.n_vertices())])
      return false;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
      {
        const int a = vertex(edge.first, i), b = vertex(edge.first, i + 1),
                  c = vertex(edge.second, j), d = vertex(edge.second, j + 1);
        if (!edges.at(key(edge.first, i)).is_inside && !edges.at(key(edge.second, j)).is_inside &&
            a != c && a != d && b != c && b != d)
          return true;
      }
    return false;
  }

  const TriangleMesh &mesh;
  const std::vector<int> torus, group_of_phase;
  std::vector<char> on_boundary; ///< vertices
  std::unordered_map<long, Edge> edges;
};

/// Strips of one triangle across, of a group.
struct Thin
{
  int n = 0, triangle = -1;
};
} // namespace

std::vector<Finding> lint_thin_parts(const UnitCell &cell, const double metres_per_unit)
{
  const TriangleMesh &mesh = cell.mesh;
  const GroupEdges groups(cell);
  const std::vector<int> phase_of_group = cell.phase_of_group();
  std::vector<Thin> thin(phase_of_group.size());
  for (const auto &[its_key, edge] : groups.edges)
    if (groups.is_across_strip(its_key, edge))
    {
      Thin &its = thin[static_cast<std::size_t>(groups.group(edge.first))];
      ++its.n;
      const int low = std::min(edge.first, edge.second);
      if (its.triangle < 0 || low < its.triangle)
        its.triangle = low;
    }
  std::vector<Finding> findings;
  for (std::size_t p = 0; p < thin.size(); ++p)
    if (thin[p].n > 0)
    {
      const Place place = place_of(mesh, thin[p].triangle);
      std::ostringstream what;
      what << "phase `" << cell.phases[static_cast<std::size_t>(phase_of_group[p])].name
           << "` has a single element across in " << thin[p].n
           << (thin[p].n == 1 ? " place" : " places") << ", the first"
           << place_text(place.point, metres_per_unit);
      findings.push_back({Severity::warning, "one element across", what.str(),
                          "expected two or more, because one cannot bend: mesh finer there, or "
                          "compute with --order 2 or --refine 1",
                          place});
    }
  return findings;
}
} // namespace homespun::homogenization
