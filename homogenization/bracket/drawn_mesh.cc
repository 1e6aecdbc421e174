// SPDX-License-Identifier: MIT
#include "homogenization/bracket/drawn_mesh.h"

#include "homogenization/bracket/loewner.h"
#include "meshes/plain/cross.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"
#include "meshes/plain/symmetric_eigen.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace homespun::homogenization
{
using meshes::at;
using meshes::cross;

namespace
{
/// Uncertain triangles are at least this high, relative to their chord: flatter ones would cost the
/// stresses on them their digits. That shows in no bracket wider than its square.
constexpr double least_height = 1e-4;

/// In the place of a material: a hole.
constexpr int no_material = -1;

class Carving
{
public:
  Carving(const TorusMesh &given, const std::vector<Eigen::Matrix3d> &stiffness_of_material)
      : given(given)
  {
    result.mesh      = given;
    result.lower     = stiffness_of_material;
    result.upper     = stiffness_of_material;
    result.n_certain = static_cast<int>(stiffness_of_material.size());
    result.mesh.triangles.clear();
    materials.assign(given.edges.size(), {no_material, no_material});
    for (const TorusTriangle &triangle : given.triangles)
      for (const int e : triangle.edges)
      {
        auto &[one, other]                 = materials[at(e)];
        (one == no_material ? one : other) = triangle.material;
      }
    for (int t = 0; t < given.n_triangles(); ++t)
      carve(t);
    for (TorusEdge &edge : result.mesh.edges)
      edge.bulge.setZero();
  }

  DrawnMesh result;

private:
  /// How far the curve of an edge rises into a triangle, at its middle, times the length of the
  /// edge; negative where it rises out of it.
  double rise(const TorusTriangle &triangle, const std::size_t k) const
  {
    const TorusEdge &edge = result.mesh.edges[at(triangle.edges[k])];
    return triangle.signs[k] * cross(edge.vector, edge.bulge);
  }

  /// From the middle of an edge to an apex: the control point, or above it, where that is too low,
  /// on an isosceles triangle that holds it.
  static Eigen::Vector2d to_apex(const TorusEdge &edge)
  {
    const double length = edge.vector.norm();
    const double across = 2. * cross(edge.vector, edge.bulge) / length,
                 along  = 2. * std::abs(edge.vector.dot(edge.bulge)) / length;
    if (std::abs(across) >= least_height * length)
      return 2. * edge.bulge;
    const double height =
      std::max(std::abs(across) / (1. - 2. * along / length), least_height * length);
    const Eigen::Vector2d normal(-edge.vector(1) / length, edge.vector(0) / length);
    return (across > 0. ? height : -height) * normal;
  }

  /// Where the apex over edge k lies, seen from vertex 0.
  Eigen::Vector2d apex(const TorusTriangle &triangle, const std::size_t k) const
  {
    const TorusEdge &edge = result.mesh.edges[at(triangle.edges[k])];
    return triangle.shape(result.mesh.edges)[k] + 0.5 * triangle.signs[k] * edge.vector +
           to_apex(edge);
  }

  int add_vertex(const TorusTriangle &triangle, const Eigen::Vector2d &from_first)
  {
    const VertexOrigin &home = result.mesh.origins[at(triangle.vertices[0])];
    result.mesh.origins.push_back({home.vertex, home.offset + from_first});
    return result.mesh.n_vertices++;
  }

  /// The edge from a vertex to a new one.
  int add_edge(const int from, const int to, const Eigen::Vector2d &vector)
  {
    result.mesh.edges.push_back({from, to, vector});
    return result.mesh.n_edges() - 1;
  }

  /// Three triangles about a point, the k-th one with the edge k of the triangle as its edge 0.
  std::array<TorusTriangle, 3> split(const TorusTriangle &triangle, const Eigen::Vector2d &point)
  {
    const auto shape = triangle.shape(result.mesh.edges);
    const int middle = add_vertex(triangle, point);
    std::array<int, 3> spokes;
    for (std::size_t k = 0; k < 3; ++k)
      spokes[k] = add_edge(triangle.vertices[k], middle, point - shape[k]);
    std::array<TorusTriangle, 3> parts;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t next = (k + 1) % 3;
      parts[k]               = {{triangle.vertices[k], triangle.vertices[next], middle},
                                {triangle.edges[k], spokes[next], spokes[k]},
                                {triangle.signs[k], 1., -1.},
                                triangle.material,
                                triangle.corner + shape[k]};
    }
    return parts;
  }

  void keep(const TorusTriangle &triangle, const int parent, const bool is_void_below = false,
            const bool is_flat = false)
  {
    result.is_flat.push_back(is_flat);
    result.mesh.triangles.push_back(triangle);
    result.parent.push_back(parent);
    result.is_void_below.push_back(is_void_below);
  }

  /// An element that may be of any of some materials, or of none.
  void keep_uncertain(TorusTriangle triangle, const int parent, std::vector<int> candidates,
                      const bool is_flat = true)
  {
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    const bool may_be_void = candidates.front() == no_material;
    if (may_be_void)
      candidates.erase(candidates.begin());
    const auto [place, is_new] =
      uncertain.emplace(candidates, static_cast<int>(result.lower.size()));
    if (is_new)
    {
      Eigen::Matrix3d lower = result.lower[at(candidates[0])], upper = lower;
      for (const int material : candidates)
      {
        lower = below_both(lower, result.lower[at(material)]);
        upper = above_both(upper, result.upper[at(material)]);
      }
      result.lower.push_back(lower);
      result.upper.push_back(upper);
    }
    triangle.material = place->second;
    keep(triangle, parent, may_be_void, is_flat);
  }

  int across(const TorusTriangle &triangle, const std::size_t k) const
  {
    const auto &[one, other] = materials[at(triangle.edges[k])];
    return one == triangle.material ? other : one;
  }

  void carve(const int t)
  {
    const TorusTriangle &triangle = given.triangles[at(t)];
    std::vector<std::size_t> arcs;
    for (std::size_t k = 0; k < 3; ++k)
      if (rise(triangle, k) > 0.)
        arcs.push_back(k);
      else if (rise(triangle, k) < 0. && across(triangle, k) == no_material)
        fill_hole(triangle, k, t);
    if (arcs.empty())
      keep(triangle, t);
    else if (!fits(triangle, arcs))
    {
      std::vector<int> candidates = {triangle.material};
      for (const std::size_t k : arcs)
        candidates.push_back(across(triangle, k));
      keep_uncertain(triangle, t, candidates, false);
    }
    else if (arcs.size() == 1)
      carve_arc(triangle, arcs[0], t);
    else
      for (const TorusTriangle &part : split(triangle, centroid(triangle)))
        if (rise(part, 0) > 0.)
          carve_arc(part, 0, t);
        else
          keep(part, t);
  }

  void carve_arc(const TorusTriangle &triangle, const std::size_t k, const int parent)
  {
    const int other  = across(triangle, k);
    const auto parts = split(triangle, apex(triangle, k));
    for (std::size_t part = 0; part < 3; ++part)
      if (part == k)
        keep_uncertain(parts[part], parent, {triangle.material, other});
      else
        keep(parts[part], parent);
  }

  /// Behind a curve that bulges into a hole there may be more of the triangle's material.
  void fill_hole(const TorusTriangle &triangle, const std::size_t k, const int parent)
  {
    const auto shape            = triangle.shape(result.mesh.edges);
    const std::size_t next      = (k + 1) % 3;
    const Eigen::Vector2d point = apex(triangle, k);
    const int middle            = add_vertex(triangle, point);
    const int from = triangle.vertices[k], to = triangle.vertices[next];
    const int first  = add_edge(from, middle, point - shape[k]),
              second = add_edge(to, middle, point - shape[next]);
    keep_uncertain({{to, from, middle},
                    {triangle.edges[k], first, second},
                    {-triangle.signs[k], 1., -1.},
                    triangle.material,
                    triangle.corner + shape[next]},
                   parent, {triangle.material, no_material});
  }

  Eigen::Vector2d centroid(const TorusTriangle &triangle) const
  {
    const auto shape = triangle.shape(result.mesh.edges);
    return (shape[1] + shape[2]) / 3.;
  }

  /// Whether each apex lies inside of the triangle, or of its part about the centroid where there
  /// are several.
  /// @throws BadInput where a control point lies outside of the triangle: nobody knows then whose
  ///   the place is
  bool fits(const TorusTriangle &triangle, const std::vector<std::size_t> &arcs) const
  {
    const auto shape                             = triangle.shape(result.mesh.edges);
    const std::array<Eigen::Vector2d, 3> corners = shape;
    const auto is_inside =
      [&](const std::size_t k, const Eigen::Vector2d &third, const Eigen::Vector2d &point)
    {
      // Beside the chord: with room, so that no triangle loses its shape.
      constexpr double room       = 0.02;
      const Eigen::Vector2d &from = corners[k], &to = corners[(k + 1) % 3];
      const double area = cross(to - from, third - from);
      return cross(third - to, point - to) > room * area &&
             cross(from - third, point - third) > room * area;
    };
    bool all_fit = true;
    for (const std::size_t k : arcs)
    {
      const TorusEdge &edge = result.mesh.edges[at(triangle.edges[k])];
      const Eigen::Vector2d control =
        corners[k] + 0.5 * triangle.signs[k] * edge.vector + 2. * edge.bulge;
      const Eigen::Vector2d &third = corners[(k + 2) % 3], &to = corners[(k + 1) % 3];
      if (!(cross(third - to, control - to) > 0. &&
            cross(corners[k] - third, control - third) > 0.))
      {
        std::ostringstream text;
        text << "a curved side at ("
             << (triangle.corner + corners[k] + 0.5 * triangle.signs[k] * edge.vector).transpose()
             << ") m leaves the triangle that it bulges into; expected sides that bend by less "
                "than half of the angles beside them: mesh finer there (Gmsh: "
                "Mesh.MeshSizeFromCurvature)";
        throw meshes::BadInput(text.str());
      }
      all_fit =
        all_fit && is_inside(k, arcs.size() == 1 ? third : centroid(triangle), apex(triangle, k));
    }
    return all_fit;
  }

  const TorusMesh &given;
  std::vector<std::array<int, 2>> materials; ///< on both sides of the given edges
  std::map<std::vector<int>, int> uncertain; ///< material by its candidates
};
} // namespace

Eigen::Matrix3d above_both(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B)
{
  const Eigen::LLT<Eigen::Matrix3d> factors(A);
  const Eigen::Matrix3d half  = factors.matrixL().solve(B);
  const Eigen::Matrix3d both  = factors.matrixL().solve(half.transpose());
  const auto eigen            = meshes::symmetric_eigen<3>(0.5 * (both + both.transpose()));
  const Eigen::Matrix3d V     = factors.matrixL() * eigen.vectors;
  const Eigen::Matrix3d above = V * eigen.values.cwiseMax(1.).asDiagonal() * V.transpose();
  // Roundings, in parts of A as far as that is weak: generous, for what is uncertain hardly counts.
  const double roundings =
    32. * std::numeric_limits<double>::epsilon() * weakness(A) * (1. + eigen.values(2));
  const Eigen::Matrix3d diagonal = A.diagonal().asDiagonal();
  return 0.5 * (above + above.transpose()) + 3. * roundings * diagonal;
}

Eigen::Matrix3d below_both(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B)
{
  // The larger of both compliances.
  const RoundedInverse a = inverse_of(A), b = inverse_of(B);
  const RoundedInverse below =
    inverse_of(above_both(a.value / (1. - a.round_off), b.value / (1. - b.round_off)));
  return (1. - below.round_off) * below.value;
}

DrawnMesh drawn(const TorusMesh &mesh, const std::vector<Eigen::Matrix3d> &stiffness_of_material)
{
  return Carving(mesh, stiffness_of_material).result;
}

TorusMesh with_only(const TorusMesh &mesh, const std::vector<char> &is_kept)
{
  TorusMesh kept = mesh;
  kept.triangles.clear();
  kept.edges.clear();
  std::vector<int> vertex(at(mesh.n_vertices), -1), edge(mesh.edges.size(), -1);
  const auto n_given = static_cast<int>(mesh.reach.size());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    if (is_kept[at(t)])
      for (const int v : mesh.triangles[at(t)].vertices)
        vertex[at(v)] = 0;
  kept.n_vertices = 0;
  kept.origins.clear();
  for (int v = 0; v < mesh.n_vertices; ++v)
    if (v < n_given || vertex[at(v)] == 0) // those of the given mesh keep their numbers
    {
      vertex[at(v)] = kept.n_vertices++;
      kept.origins.push_back(mesh.origins[at(v)]);
    }
  for (int t = 0; t < mesh.n_triangles(); ++t)
    if (is_kept[at(t)])
    {
      TorusTriangle triangle = mesh.triangles[at(t)];
      for (int &v : triangle.vertices)
        v = vertex[at(v)];
      for (int &e : triangle.edges)
      {
        if (edge[at(e)] < 0)
        {
          edge[at(e)]        = kept.n_edges();
          TorusEdge its_edge = mesh.edges[at(e)];
          its_edge.tail      = vertex[at(its_edge.tail)];
          its_edge.head      = vertex[at(its_edge.head)];
          kept.edges.push_back(its_edge);
        }
        e = edge[at(e)];
      }
      kept.triangles.push_back(triangle);
    }
  return kept;
}
} // namespace homespun::homogenization
