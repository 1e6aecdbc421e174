// SPDX-License-Identifier: MIT
#include "meshes/cloth/cloth_faults.h"

#include "meshes/cloth/seams.h"
#include "meshes/plain/fault_list.h"
#include "meshes/plain/triangle_area.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace homespun::meshes
{
namespace
{
/// How near to an edge, as a part of its length, a vertex counts as lying on it: files with six
/// digits place a point on an edge of a centimetre to 5e-5.
constexpr double on_edge = 1e-4;

template <typename Positions>
std::string at(const Positions &positions, const int vertex)
{
  std::ostringstream text;
  text << '(';
  for (Eigen::Index i = 0; i < positions.cols(); ++i)
    text << (i == 0 ? "" : ", ") << positions(vertex, i);
  text << ") m";
  return text.str();
}

/// Indices and coordinates.
/// @param kind of vertices, "vertex" or "rest vertex"
template <typename Positions>
void add_number_faults(FaultList &faults, const Positions &positions, const Triangles &triangles,
                       const std::string &kind)
{
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    if (!positions.row(v).allFinite())
      faults.add("vertices that are not finite",
                 kind + " " + std::to_string(v) +
                   " has coordinates that are not finite numbers; expected metres");
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      if (triangles(t, k) < 0 || triangles(t, k) >= positions.rows())
        faults.add("indices out of range", "triangle " + std::to_string(t) + " names " + kind +
                                             " " + std::to_string(triangles(t, k)) +
                                             "; expected 0 to " +
                                             std::to_string(positions.rows() - 1));
}

template <typename Positions>
void add_isolated(FaultList &faults, const Positions &positions, const Triangles &triangles,
                  const std::string &kind)
{
  std::vector<char> is_used(static_cast<std::size_t>(positions.rows()), 0);
  for (Eigen::Index k = 0; k < triangles.size(); ++k)
    is_used[static_cast<std::size_t>(triangles.data()[k])] = 1;
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    if (!is_used[static_cast<std::size_t>(v)])
      faults.add("isolated vertices", kind + " " + std::to_string(v) + " at " +
                                        at(positions, static_cast<int>(v)) +
                                        " belongs to no triangle; expected none such: remove it");
}

using Edge = std::array<int, 2>;

/// The triangles along each edge in space, lower vertex first: triangle and whether it runs
/// upwards.
std::map<Edge, std::vector<std::pair<int, bool>>> edges_of(const Triangles &triangles)
{
  std::map<Edge, std::vector<std::pair<int, bool>>> edges;
  for (int t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int from = triangles(t, k), to = triangles(t, (k + 1) % 3);
      edges[{std::min(from, to), std::max(from, to)}].emplace_back(t, from < to);
    }
  return edges;
}

/// Edges with more than two triangles, and neighbours wound against each other.
void add_edge_faults(FaultList &faults, const SpacePoints &positions, const Triangles &triangles)
{
  for (const auto &[edge, owners] : edges_of(triangles))
  {
    const std::string place = "the edge between vertices " + std::to_string(edge[0]) + " and " +
                              std::to_string(edge[1]) + " near " + at(positions, edge[0]);
    if (owners.size() > 2)
    {
      std::string list;
      for (const auto &owner : owners)
        list.append(list.empty() ? "" : ", ").append(std::to_string(owner.first));
      faults.add("edges with more than two triangles",
                 place + " belongs to " + std::to_string(owners.size()) + " triangles (" + list +
                   "); expected one or two: separate the layers that meet there");
    }
    else if (owners.size() == 2 && owners[0].second == owners[1].second)
      faults.add("edges with inconsistent winding",
                 place + " is traversed the same way by triangles " +
                   std::to_string(owners[0].first) + " and " + std::to_string(owners[1].first) +
                   "; expected opposite ways: turn one of them, or make normals consistent");
  }
}

void add_duplicates(FaultList &faults, const ClothMesh &cloth)
{
  const auto sorted = [](std::array<int, 3> corners)
  {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  // In space the winding counts: a pouch of two triangles is no duplicate.
  const auto rotated = [](std::array<int, 3> corners)
  {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
  };
  std::map<std::array<int, 3>, int> at_rest, in_space;
  for (int t = 0; t < cloth.n_triangles(); ++t)
  {
    const auto &rest           = cloth.rest.triangles;
    const auto &space          = cloth.triangles;
    const auto [first, is_new] = at_rest.emplace(sorted({rest(t, 0), rest(t, 1), rest(t, 2)}), t);
    const auto [second, is_also_new] =
      in_space.emplace(rotated({space(t, 0), space(t, 1), space(t, 2)}), t);
    if (!is_new || !is_also_new)
      faults.add("duplicate triangles", "triangle " + std::to_string(t) + " repeats triangle " +
                                          std::to_string(is_new ? second->second : first->second) +
                                          "; expected each once: delete one");
  }
}

void add_rest_shapes(FaultList &faults, const ClothMesh &cloth)
{
  const Panels panels         = panels_of(cloth);
  const Eigen::VectorXd areas = signed_areas(cloth.rest);
  Eigen::VectorXd positive = Eigen::VectorXd::Zero(panels.count), negative = positive;
  Eigen::VectorXi members = Eigen::VectorXi::Zero(panels.count);
  for (int t = 0; t < cloth.n_triangles(); ++t)
  {
    const int panel = panels.of_triangle(t);
    ++members(panel);
    (areas(t) > 0. ? positive : negative)(panel) += std::abs(areas(t));
  }
  std::vector<char> was_told(static_cast<std::size_t>(panels.count), 0);
  for (int t = 0; t < cloth.n_triangles(); ++t)
  {
    const int panel        = panels.of_triangle(t);
    const TriangleArea its = triangle_area<2>(cloth.rest.vertices, cloth.rest.triangles.row(t));
    std::ostringstream text;
    text << "triangle " << t << " near the rest point "
         << at(cloth.rest.vertices, cloth.rest.triangles(t, 0));
    if (!its.is_there())
    {
      text << " has no area at rest: it is " << std::abs(its.height())
           << " times as high as its longest edge of " << its.longest_edge
           << " m is long; expected a proper triangle: merge its vertices or unwrap it again";
      faults.add("triangles without area at rest", text.str());
    }
    else if (negative(panel) > positive(panel))
    {
      if (areas(t) > 0. || was_told[static_cast<std::size_t>(panel)]++)
        continue;
      std::ostringstream whole;
      whole
        << "panel " << panel << " (" << members(panel) << " triangles, triangle " << t
        << " is one of them) is mirrored at rest: its vt run clockwise; expected "
           "counter-clockwise, like the outside in space: mirror the vt of this panel (u to −u)";
      faults.add("mirrored panels", whole.str());
    }
    else if (areas(t) < 0.)
    {
      text
        << " is flipped at rest (area " << areas(t) << " m^2 among panel " << panel
        << ", which is not mirrored); expected counter-clockwise vt: turn it, or untangle the vt "
           "there";
      faults.add("triangles flipped at rest", text.str());
    }
  }
}

/// Calls found(vertex, edge, part) where a vertex lies inside an edge, part of its length from its
/// first end. A sweep along the first axis.
template <typename Positions, typename Found>
void vertices_inside_edges(const Positions &positions, std::vector<int> vertices,
                           const std::vector<Edge> &edges, const Found &found)
{
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::sort(vertices.begin(), vertices.end(),
            [&](const int a, const int b) { return positions(a, 0) < positions(b, 0); });
  for (const Edge &edge : edges)
  {
    const auto from = positions.row(edge[0]).eval(), along = (positions.row(edge[1]) - from).eval();
    const double length = along.norm(), margin = on_edge * length;
    const double low   = std::min(from(0), from(0) + along(0)) - margin,
                 high  = std::max(from(0), from(0) + along(0)) + margin;
    const auto is_left = [&](const int v, const double x) { return positions(v, 0) < x; };
    auto place         = std::lower_bound(vertices.begin(), vertices.end(), low, is_left);
    for (; place != vertices.end() && positions(*place, 0) <= high; ++place)
    {
      const int v = *place;
      if (v == edge[0] || v == edge[1])
        continue;
      const auto to     = (positions.row(v) - from).eval();
      const double part = to.dot(along) / (length * length);
      if (part > on_edge && part < 1. - on_edge && (to - part * along).norm() < margin)
        found(v, edge);
    }
  }
}

/// At rest: outlines of panels, each on its own.
void add_junctions_at_rest(FaultList &faults, const ClothMesh &cloth, const Panels &panels)
{
  std::vector<std::vector<Edge>> outlines(static_cast<std::size_t>(panels.count));
  std::vector<std::vector<int>> corners(static_cast<std::size_t>(panels.count));
  for (const auto &[edge, owners] : edges_of(cloth.rest.triangles))
    if (owners.size() == 1)
    {
      const auto panel = static_cast<std::size_t>(panels.of_vertex(edge[0]));
      outlines[panel].push_back(edge);
      corners[panel].insert(corners[panel].end(), edge.begin(), edge.end());
    }
  for (std::size_t panel = 0; panel < outlines.size(); ++panel)
    vertices_inside_edges(
      cloth.rest.vertices, corners[panel], outlines[panel],
      [&](const int v, const Edge &edge)
      {
        faults.add("T-junctions",
                   "rest vertex " + std::to_string(v) + " at " + at(cloth.rest.vertices, v) +
                     " lies inside the edge between rest vertices " + std::to_string(edge[0]) +
                     " and " + std::to_string(edge[1]) + " of panel " + std::to_string(panel) +
                     " (a T-junction); expected triangles that share whole edges: split the "
                     "triangle of that edge there");
      });
}

/// In space: open edges. Two that leave one vertex and lie on each other were meant to be sewn. Of
/// one panel, which may lie folded on itself, only where it is sewn up to that vertex: there the
/// cloth goes around it, or meets in it alone.
void add_junctions_in_space(FaultList &faults, const ClothMesh &cloth, const Panels &panels)
{
  constexpr double around      = 5. / 3. * M_PI; // but for a wedge of 60 degrees
  const Eigen::VectorXd angles = sewn_angles(cloth);
  std::set<std::array<int, 2>> panels_at; // vertex in space, panel
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (const int v : cloth.triangles.row(t))
      panels_at.insert({v, panels.of_triangle(t)});
  std::vector<Edge> open;
  std::vector<int> ends;
  std::map<int, std::vector<int>> next;
  const auto edges = edges_of(cloth.triangles);
  for (const auto &[edge, owners] : edges)
    if (owners.size() == 1)
    {
      open.push_back(edge);
      ends.insert(ends.end(), edge.begin(), edge.end());
      next[edge[0]].push_back(edge[1]);
      next[edge[1]].push_back(edge[0]);
    }
  vertices_inside_edges(
    cloth.positions, ends, open,
    [&](const int v, const Edge &edge)
    {
      const auto &neighbours = next[v];
      const bool may_fold   = panels_at.count({v, panels.of_triangle(edges.at(edge)[0].first)}) > 0;
      const auto is_sewn_at = [&](const int end)
      {
        return std::find(neighbours.begin(), neighbours.end(), end) != neighbours.end() &&
               (!may_fold || angles(end) > (next[end].size() > 2 ? 0. : around));
      };
      if (!is_sewn_at(edge[0]) && !is_sewn_at(edge[1]))
        return;
      faults.add("T-junctions",
                 "vertex " + std::to_string(v) + " at " + at(cloth.positions, v) +
                   " lies inside the edge between vertices " + std::to_string(edge[0]) + " and " +
                   std::to_string(edge[1]) +
                   " in space (a T-junction in a seam); expected sides of a seam that share all "
                   "vertices: split the triangle of that edge there");
    });
}
} // namespace

std::vector<std::string> cloth_faults(const ClothMesh &cloth, const std::string &name)
{
  FaultList faults(name);
  if (cloth.n_triangles() == 0)
    faults.add("empty meshes", "no triangle found; expected at least one");
  else if (cloth.rest.n_vertices() == 0)
    faults.add("cloths without vt", "cloth without vt: export UV coordinates in metres");
  else if (cloth.rest.n_triangles() != cloth.n_triangles())
    faults.add("sizes", "has " + std::to_string(cloth.rest.n_triangles()) +
                          " triangles at rest and " + std::to_string(cloth.n_triangles()) +
                          " in space; expected as many");
  else
  {
    add_number_faults(faults, cloth.rest.vertices, cloth.rest.triangles, "rest vertex");
    add_number_faults(faults, cloth.positions, cloth.triangles, "vertex");
  }
  if (cloth.rest.material.size() != cloth.rest.n_triangles())
    faults.add("sizes", std::to_string(cloth.rest.material.size()) + " material numbers for " +
                          std::to_string(cloth.rest.n_triangles()) +
                          " triangles; expected as many");
  if (!faults.empty())
    return faults.take();

  const Eigen::VectorXi space = space_of_rest(cloth);
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const int v = cloth.rest.triangles(t, k); space(v) != cloth.triangles(t, k))
        faults.add("rest vertices with two places in space",
                   "rest vertex " + std::to_string(v) + " stands for vertices " +
                     std::to_string(cloth.triangles(t, k)) + " and " + std::to_string(space(v)) +
                     " in space; expected one: give each its own rest vertex");
  add_rest_shapes(faults, cloth);
  add_duplicates(faults, cloth);
  add_edge_faults(faults, cloth.positions, cloth.triangles);
  const Panels panels = panels_of(cloth);
  add_junctions_at_rest(faults, cloth, panels);
  add_junctions_in_space(faults, cloth, panels);
  add_isolated(faults, cloth.positions, cloth.triangles, "vertex");
  add_isolated(faults, cloth.rest.vertices, cloth.rest.triangles, "rest vertex");
  return faults.take();
}

std::vector<std::string> surface_faults(const Surface &surface, const std::string &name)
{
  FaultList faults(name);
  const SpacePoints &x       = surface.positions;
  const Triangles &triangles = surface.triangles;
  if (triangles.rows() == 0)
    faults.add("empty meshes", "no triangle found; expected at least one");
  add_number_faults(faults, x, triangles, "vertex");
  if (!faults.empty())
    return faults.take();

  double volume = 0.; // six times, from a vertex of the surface, so that its place does not matter
  std::map<std::array<int, 3>, int> first_with;
  for (int t = 0; t < triangles.rows(); ++t)
  {
    const Eigen::RowVector3d x0 = x.row(triangles(t, 0)), e1 = x.row(triangles(t, 1)) - x0,
                             e2 = x.row(triangles(t, 2)) - x0;
    const TriangleArea its      = triangle_area<3>(x, triangles.row(t));
    if (!its.is_there())
    {
      std::ostringstream text;
      text << "triangle " << t << " near " << at(x, triangles(t, 0)) << " has no area: it is "
           << its.height() << " times as high as its longest edge of " << its.longest_edge
           << " m is long; expected a proper triangle: merge its vertices";
      faults.add("triangles without area", text.str());
    }
    volume += (x0 - x.row(triangles(0, 0))).dot(e1.cross(e2));
    std::array<int, 3> corners = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::sort(corners.begin(), corners.end());
    if (const auto [place, is_new] = first_with.emplace(corners, t); !is_new)
      faults.add("duplicate triangles", "triangle " + std::to_string(t) + " repeats triangle " +
                                          std::to_string(place->second) +
                                          "; expected each once: delete one");
  }
  add_edge_faults(faults, x, triangles);
  for (const auto &[edge, owners] : edges_of(triangles))
    if (owners.size() == 1)
      faults.add("open edges",
                 "the edge between vertices " + std::to_string(edge[0]) + " and " +
                   std::to_string(edge[1]) + " near " + at(x, edge[0]) + " belongs to triangle " +
                   std::to_string(owners[0].first) +
                   " only; expected a closed surface: fill the hole, or merge vertices that "
                   "coincide");
  add_isolated(faults, x, triangles, "vertex");
  if (faults.empty() && !(volume > 0.))
    faults.add("surfaces inside out",
               "the surface is inside out; expected triangles counter-clockwise seen from outside: "
               "turn all of them");
  return faults.take();
}
} // namespace homespun::meshes
