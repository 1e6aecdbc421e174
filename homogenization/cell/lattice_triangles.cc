// SPDX-License-Identifier: MIT
#include "homogenization/cell/lattice_triangles.h"

#include "meshes/plain/cross.h"
#include "meshes/plain/index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace homespun::homogenization
{
using meshes::at;
using meshes::cross;

namespace
{
/// The edge between two corners, and whether it runs from the first of them.
std::pair<LatticeEdge, bool> directed_edge(const LatticeCorner &from, const LatticeCorner &to)
{
  const Eigen::RowVector2i step = to.offset - from.offset;
  const bool is_forwards =
    std::make_tuple(to.vertex - from.vertex, step(0), step(1)) > std::make_tuple(0, 0, 0);
  if (is_forwards)
    return {{from.vertex, to.vertex, step(0), step(1)}, true};
  return {{to.vertex, from.vertex, -step(0), -step(1)}, false};
}

/// What lies on either side of an edge.
struct EdgeSides
{
  int n_forwards = 0, n_backwards = 0; ///< triangles that run along it from its first vertex, to it
  int first_group = -1;
  bool is_inside  = false; ///< of one group
};

std::map<LatticeEdge, EdgeSides> sides_of_edges(const LatticeTriangles &mesh)
{
  std::map<LatticeEdge, EdgeSides> sides;
  for (const LatticeTriangle &triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto [edge, is_forwards] =
        directed_edge(triangle.corners[k], triangle.corners[(k + 1) % 3]);
      EdgeSides &its = sides[edge];
      ++(is_forwards ? its.n_forwards : its.n_backwards);
      its.is_inside   = its.n_forwards + its.n_backwards == 2 && its.first_group == triangle.group;
      its.first_group = triangle.group;
    }
  return sides;
}
} // namespace

LatticeEdge edge_between(const LatticeCorner &from, const LatticeCorner &to)
{
  return directed_edge(from, to).first;
}

std::optional<LatticeTriangles> glued_with_rims(const meshes::TriangleMesh &mesh,
                                                const meshes::Lattice &lattice,
                                                const Eigen::VectorXi &group,
                                                const std::vector<CurvedSide> &curved_sides,
                                                const double relative_tolerance)
{
  std::vector<int> boundary;
  for (const std::array<int, 2> &edge : meshes::boundary_edges(mesh))
    boundary.insert(boundary.end(), edge.begin(), edge.end());
  std::sort(boundary.begin(), boundary.end());
  boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
  meshes::Points points(static_cast<Eigen::Index>(boundary.size()), 2);
  for (std::size_t k = 0; k < boundary.size(); ++k)
    points.row(static_cast<Eigen::Index>(k)) = mesh.vertices.row(boundary[k]);
  const meshes::ImageClasses classes = meshes::match_images(points, lattice, relative_tolerance);

  LatticeTriangles glued;
  glued.lattice = lattice;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    glued.places.push_back(lattice.fractional(mesh.vertices.row(v)));
  std::vector<LatticeCorner> corner_of(at(mesh.n_vertices()));
  for (int v = 0; v < mesh.n_vertices(); ++v)
    corner_of[at(v)] = {v, {0, 0}};
  std::map<std::array<int, 3>, int> vertex_at;
  for (std::size_t k = 0; k < boundary.size(); ++k)
  {
    const int first                    = boundary[at(classes.representative[k])];
    const Eigen::RowVector2i offset    = classes.offset.row(static_cast<Eigen::Index>(k));
    corner_of[at(boundary[k])]         = {first, offset};
    const std::array<int, 3> its_place = {first, offset(0), offset(1)};
    if (!vertex_at.emplace(its_place, boundary[k]).second)
      return std::nullopt;
  }
  for (int t = 0; t < mesh.n_triangles(); ++t)
    glued.triangles.push_back(
      {{corner_of[at(mesh.triangles(t, 0))], corner_of[at(mesh.triangles(t, 1))],
        corner_of[at(mesh.triangles(t, 2))]},
       mesh.material(t),
       group(t)});
  const auto sides = sides_of_edges(glued);
  for (const auto &[edge, its] : sides)
    if (its.n_forwards > 1 || its.n_backwards > 1)
      return std::nullopt;
  for (const CurvedSide &side : curved_sides)
  {
    const LatticeEdge edge = edge_between(corner_of[at(side.a)], corner_of[at(side.b)]);
    const auto its         = sides.find(edge);
    if (its != sides.end() && !its->second.is_inside)
      glued.bulges[edge] = lattice.fractional(side.sagitta.transpose());
  }
  return glued;
}

namespace
{
struct RimEdge
{
  LatticeCorner from, to;
  std::array<int, 2> side; ///< triangle, and which of its sides
  bool is_left = true;
};

/// The angle of the void between an edge that ends in a vertex and one that begins there. Where
/// triangles overlap it is negative: a spike of the mesh, with almost all around it void, is no
/// such place.
double void_angle(const Eigen::RowVector2d &arriving, const Eigen::RowVector2d &leaving)
{
  constexpr double narrowest_spike = M_PI / 6.;
  const double angle = std::atan2(cross(-arriving, leaving), -arriving.dot(leaving)); // -pi to pi
  return angle < -narrowest_spike ? angle + 2. * M_PI : angle;
}
} // namespace

std::vector<Rim> rims_of(const LatticeTriangles &mesh)
{
  const auto sides = sides_of_edges(mesh);
  std::vector<RimEdge> edges;
  std::map<int, std::vector<std::size_t>> leaving;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto &corners       = mesh.triangles[t].corners;
      const LatticeCorner &from = corners[k], &to = corners[(k + 1) % 3];
      const EdgeSides &its = sides.at(edge_between(from, to));
      if (its.n_forwards + its.n_backwards > 1)
        continue;
      leaving[from.vertex].push_back(edges.size());
      edges.push_back({from, to, {static_cast<int>(t), static_cast<int>(k)}});
    }
  const auto vector_of = [&](const RimEdge &edge) -> Eigen::RowVector2d
  { return (mesh.at(edge.to) - mesh.at(edge.from)) * mesh.lattice.vectors; };
  std::vector<Rim> rims;
  for (RimEdge &first : edges)
  {
    if (!first.is_left)
      continue;
    Rim rim;
    const Eigen::RowVector2d origin = mesh.at(first.from);
    Eigen::RowVector2d place        = origin;
    RimEdge *edge                   = &first;
    while (true)
    {
      edge->is_left               = false;
      const Eigen::RowVector2d to = place + mesh.at(edge->to) - mesh.at(edge->from);
      rim.points.push_back(place);
      rim.reach.push_back(place);
      rim.sides.push_back(edge->side);
      if (const auto bulge = mesh.bulges.find(edge_between(edge->from, edge->to));
          bulge != mesh.bulges.end())
        rim.reach.push_back(0.5 * (place + to) + 2. * bulge->second);
      rim.area += 0.5 * cross(place - origin, to - origin);
      place = to;
      // Where rims touch, the next edge is the first one across the void.
      RimEdge *next = nullptr;
      double least  = std::numeric_limits<double>::infinity();
      for (const std::size_t e : leaving[edge->to.vertex])
        if (const double angle = void_angle(vector_of(*edge), vector_of(edges[e]));
            (edges[e].is_left || &edges[e] == &first) && angle < least)
        {
          least = angle;
          next  = &edges[e];
        }
      if (!next)
        return {}; // a rim that does not close: no mesh has one
      rim.void_angles.push_back(least);
      if (next == &first)
        break;
      edge = next;
    }
    // At the first point the rim arrives last.
    std::rotate(rim.void_angles.begin(), rim.void_angles.end() - 1, rim.void_angles.end());
    rim.period = (place - origin).array().round().cast<int>();
    rims.push_back(rim);
  }
  return rims;
}

meshes::TriangleMesh unfolded_at(const LatticeTriangles &mesh, const Eigen::RowVector2d &corner,
                                 std::vector<CurvedSide> &curved_sides)
{
  meshes::TriangleMesh plane;
  const auto n = static_cast<Eigen::Index>(mesh.triangles.size());
  plane.triangles.resize(n, 3);
  plane.material.resize(n);
  std::map<std::array<int, 3>, int> vertex_of;
  std::vector<Eigen::RowVector2d> points;
  std::map<std::array<int, 2>, Eigen::RowVector2d> bulge_of;
  for (Eigen::Index t = 0; t < n; ++t)
  {
    const LatticeTriangle &triangle = mesh.triangles[static_cast<std::size_t>(t)];
    const auto &corners             = triangle.corners;
    const Eigen::RowVector2d centre =
      (mesh.at(corners[0]) + mesh.at(corners[1]) + mesh.at(corners[2])) / 3. - corner;
    const Eigen::RowVector2i cell(static_cast<int>(std::floor(centre(0))),
                                  static_cast<int>(std::floor(centre(1))));
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Eigen::RowVector2i offset = corners[k].offset - cell;
      const auto [place, is_new] =
        vertex_of.emplace(std::array<int, 3>{corners[k].vertex, offset(0), offset(1)},
                          static_cast<int>(points.size()));
      if (is_new) // images exactly a lattice vector apart
        points.push_back(mesh.places[at(corners[k].vertex)] * mesh.lattice.vectors +
                         offset.cast<double>() * mesh.lattice.vectors);
      plane.triangles(t, static_cast<Eigen::Index>(k)) = place->second;
    }
    plane.material(t) = triangle.material;
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto bulge = mesh.bulges.find(edge_between(corners[k], corners[(k + 1) % 3]));
          bulge != mesh.bulges.end())
      {
        const auto [low, high] =
          std::minmax(plane.triangles(t, static_cast<Eigen::Index>(k)),
                      plane.triangles(t, static_cast<Eigen::Index>((k + 1) % 3)));
        bulge_of[{low, high}] = bulge->second;
      }
  }
  plane.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t p = 0; p < points.size(); ++p)
    plane.vertices.row(static_cast<Eigen::Index>(p)) = points[p];
  curved_sides.clear();
  for (const auto &[ends, bulge] : bulge_of)
    curved_sides.push_back({ends[0], ends[1], (bulge * mesh.lattice.vectors).transpose()});
  return plane;
}
} // namespace homespun::homogenization
