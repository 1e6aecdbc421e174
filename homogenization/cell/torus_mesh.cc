// SPDX-License-Identifier: MIT
#include "homogenization/cell/torus_mesh.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"
#include "meshes/plain/vertex_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// Vertices of the torus in the order of their first vertex in the mesh, and where that one lies.
struct GluedVertices
{
  std::vector<int> of_original;
  meshes::Points positions; ///< of the originals, images exactly a lattice vector apart
  int n = 0;
};

GluedVertices glue_vertices(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice)
{
  // The sides alone: a rim may come near the image of another one without being it.
  const std::vector<int> sides       = meshes::sides_of(mesh, lattice).vertices;
  const meshes::ImageClasses classes = meshes::match_images(mesh, sides, lattice);

  GluedVertices glued;
  const Eigen::RowVector2d origin = mesh.vertices.row(0);
  glued.positions                 = mesh.vertices.rowwise() - origin;
  for (const int v : sides)
    glued.positions.row(v) = glued.positions.row(classes.representative[at(v)]) +
                             classes.offset.row(v).cast<double>() * lattice.vectors;
  std::vector<int> number(at(mesh.n_vertices()), -1);
  glued.of_original.resize(at(mesh.n_vertices()));
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    int &its_number = number[at(classes.representative[at(v)])];
    if (its_number < 0)
      its_number = glued.n++;
    glued.of_original[at(v)] = its_number;
  }
  return glued;
}

/// For each edge (lower vertex, higher vertex) of the outline the same edge on the opposite side
/// that was met first.
std::map<std::array<int, 2>, std::array<int, 2>> glue_edges(const meshes::TriangleMesh &mesh,
                                                            const GluedVertices &glued,
                                                            const meshes::Lattice &lattice)
{
  const std::vector<std::array<int, 2>> sides = meshes::sides_of(mesh, lattice).edges;
  meshes::Points midpoints(static_cast<Eigen::Index>(sides.size()), 2);
  for (std::size_t k = 0; k < sides.size(); ++k)
    midpoints.row(static_cast<Eigen::Index>(k)) =
      0.5 * (glued.positions.row(sides[k][0]) + glued.positions.row(sides[k][1]));
  const meshes::ImageClasses classes = meshes::match_images(midpoints, lattice);
  std::map<std::array<int, 2>, std::array<int, 2>> first_of;
  for (std::size_t k = 0; k < sides.size(); ++k)
  {
    const std::array<int, 2> mine = sides[k], first = sides[at(classes.representative[k])];
    if (classes.size[k] != 2)
      throw meshes::BadInput("the edge of the outline from vertex " + std::to_string(mine[0]) +
                             " to vertex " + std::to_string(mine[1]) + " has " +
                             std::to_string(classes.size[k] - 1) +
                             " periodic images; expected one: mesh opposite sides alike");
    first_of[{std::min(mine[0], mine[1]), std::max(mine[0], mine[1])}] = first;
  }
  return first_of;
}

/// Gives the edges between two materials and on rims their bulge.
/// @param edge_of a curved side @param is_paired whether it has an image on the opposite side of
///   the outline
template <typename EdgeOf, typename IsPaired>
void curve(TorusMesh &torus, const std::vector<CurvedSide> &curved_sides, const EdgeOf &edge_of,
           const IsPaired &is_paired)
{
  const double tolerance = meshes::image_tolerance * std::sqrt(torus.lattice.area());
  std::map<int, CurvedSide> alone; // without its image
  for (const CurvedSide &side : curved_sides)
  {
    const int e                  = edge_of(side);
    torus.edges[at(e)].bulge     = side.sagitta;
    const auto [place, is_first] = alone.emplace(e, side);
    const double off             = (place->second.sagitta - side.sagitta).norm();
    if (!is_paired(side) || (!is_first && off <= tolerance))
      alone.erase(place);
  }
  for (const auto &[e, side] : alone)
    if (std::max(side.sagitta.norm(), torus.edges[at(e)].bulge.norm()) > tolerance)
      throw meshes::BadInput(
        "the side of the outline from vertex " + std::to_string(side.a) + " to vertex " +
        std::to_string(side.b) +
        " is curved otherwise than its periodic image; expected the same curve: mesh opposite "
        "sides alike");
  std::vector<int> material(torus.edges.size(), -1);
  std::vector<char> is_inside(torus.edges.size(), 0);
  for (const TorusTriangle &triangle : torus.triangles)
    for (const int e : triangle.edges)
    {
      is_inside[at(e)] = material[at(e)] == triangle.material;
      material[at(e)]  = triangle.material;
    }
  for (std::size_t e = 0; e < torus.edges.size(); ++e)
    if (is_inside[e])
      torus.edges[e].bulge.setZero();
}
} // namespace

TorusMesh glued(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                const std::vector<CurvedSide> &curved_sides)
{
  const GluedVertices vertices = glue_vertices(mesh, lattice);
  const auto first_of          = glue_edges(mesh, vertices, lattice);

  TorusMesh torus;
  torus.lattice            = lattice;
  torus.n_vertices         = vertices.n;
  torus.vertex_of_original = vertices.of_original;
  torus.anchor             = vertices.of_original[at(meshes::anchor_vertex(mesh, lattice))];
  for (int v = 0; v < vertices.n; ++v)
    torus.origins.push_back({v, Eigen::Vector2d::Zero()});

  std::map<std::array<int, 2>, int> number_of;
  /// The edge of the torus between two vertices of the mesh, and whether it runs from a to b.
  const auto edge_between = [&](const int a, const int b) -> std::pair<int, double>
  {
    std::array<int, 2> key = {std::min(a, b), std::max(a, b)};
    const auto image       = first_of.find(key);
    if (image != first_of.end())
      key = {std::min(image->second[0], image->second[1]),
             std::max(image->second[0], image->second[1])};
    const Eigen::RowVector2d wanted = vertices.positions.row(b) - vertices.positions.row(a);
    const auto [place, is_new]      = number_of.emplace(key, torus.n_edges());
    if (is_new)
      torus.edges.push_back(
        {vertices.of_original[at(key[0])], vertices.of_original[at(key[1])],
         (vertices.positions.row(key[1]) - vertices.positions.row(key[0])).transpose()});
    const Eigen::Vector2d &found = torus.edges[at(place->second)].vector;
    return {place->second, found.dot(wanted.transpose()) > 0. ? 1. : -1.};
  };
  const Eigen::RowVector2d origin = mesh.vertices.row(0);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    std::array<int, 3> edges;
    std::array<double, 3> signs;
    for (int k = 0; k < 3; ++k)
      std::tie(edges[at(k)], signs[at(k)]) =
        edge_between(mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3));
    int longest = 0;
    for (int k = 1; k < 3; ++k)
    {
      const auto length = [&](const int j)
      { return torus.edges[at(edges[at(j)])].vector.squaredNorm(); };
      // Equal lengths, but for round-off, go to the edge with the lower number, whoever asks.
      const double difference = length(k) / length(longest) - 1.;
      if (difference > 1e-9 || (difference > -1e-9 && edges[at(k)] < edges[at(longest)]))
        longest = k;
    }
    TorusTriangle triangle;
    for (int k = 0; k < 3; ++k)
    {
      const int from           = (longest + k) % 3;
      triangle.vertices[at(k)] = vertices.of_original[at(mesh.triangles(t, from))];
      triangle.edges[at(k)]    = edges[at(from)];
      triangle.signs[at(k)]    = signs[at(from)];
    }
    triangle.material = mesh.material(t);
    triangle.corner   = (vertices.positions.row(mesh.triangles(t, longest)) + origin).transpose();
    torus.triangles.push_back(triangle);
  }
  torus.reach.assign(at(vertices.n), std::numeric_limits<double>::infinity());
  for (const TorusEdge &edge : torus.edges)
    for (const int end : {edge.tail, edge.head})
      torus.reach[at(end)] = std::min(torus.reach[at(end)], edge.vector.norm());
  const auto edge_of   = [&](const CurvedSide &side) { return edge_between(side.a, side.b).first; };
  const auto is_paired = [&](const CurvedSide &side) {
    return first_of.count({std::min(side.a, side.b), std::max(side.a, side.b)}) > 0;
  };
  curve(torus, curved_sides, edge_of, is_paired);
  return torus;
}

std::vector<std::array<int, 2>> rim_edges(const TorusMesh &mesh)
{
  std::vector<int> n_triangles_of(mesh.edges.size(), 0);
  for (const TorusTriangle &triangle : mesh.triangles)
    for (const int edge : triangle.edges)
      ++n_triangles_of[at(edge)];
  std::vector<std::array<int, 2>> rims;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      if (n_triangles_of[at(mesh.triangles[at(t)].edges[at(k)])] == 1)
        rims.push_back({t, k});
  return rims;
}

double relative_resolution(const TorusMesh &mesh)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const TorusEdge &edge : mesh.edges)
    shortest = std::min(shortest, edge.vector.norm());
  return shortest / std::sqrt(mesh.lattice.area());
}
} // namespace homespun::homogenization
