// SPDX-License-Identifier: MIT
// cut_along() of lattice_triangles.h.
#include "homogenization/cell/lattice_triangles.h"

#include "meshes/plain/index.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// An edge that is cut nearer to one of its ends than this part of it has that end moved onto the
/// line, where it may move.
constexpr double near = 0.3;

/// Moving a vertex must not make an angle smaller than this, unless one there is [degrees].
constexpr double fair_angle = 15.;

/// What is the same wherever a mesh is cut.
struct Surroundings
{
  std::vector<char> is_free; ///< vertices that lie inside of a group
  std::vector<std::vector<std::size_t>> triangles_at;
};

Surroundings surroundings_of(const LatticeTriangles &mesh)
{
  Surroundings result{std::vector<char>(mesh.places.size(), 1),
                      std::vector<std::vector<std::size_t>>(mesh.places.size())};
  std::vector<int> group(mesh.places.size(), -1);
  std::map<LatticeEdge, int> n_triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const LatticeTriangle &triangle = mesh.triangles[t];
      const std::size_t v             = at(triangle.corners[k].vertex);
      result.triangles_at[v].push_back(t);
      if (group[v] >= 0 && group[v] != triangle.group)
        result.is_free[v] = 0;
      group[v] = triangle.group;
      ++n_triangles[edge_between(triangle.corners[k], triangle.corners[(k + 1) % 3])];
    }
  for (const auto &[edge, n] : n_triangles)
    if (n == 1)
      result.is_free[at(edge[0])] = result.is_free[at(edge[1])] = 0;
  return result;
}

class Cutter
{
public:
  Cutter(const LatticeTriangles &given, const Surroundings &around, const int axis,
         const double level)
      : axis(axis)
      , level(level)
      , around(around)
      , mesh(given)
      , on_line(given.places.size(), 0)
      , is_changed(given.triangles.size(), 0)
  {
    for (std::size_t v = 0; v < mesh.places.size(); ++v)
      if (const double c = mesh.places[v](axis) - level;
          std::abs(c - std::round(c)) <= meshes::image_tolerance)
        put_on_line(static_cast<int>(v));
  }

  std::optional<LineCut> run()
  {
    if (!can_be_cut())
      return std::nullopt;
    for (const int v : near_vertices())
      move_if_fair(v);
    LineCut cut;
    cut.level = level;
    std::vector<LatticeTriangle> pieces;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      const std::size_t first = pieces.size();
      split(mesh.triangles[t], pieces);
      if (pieces.size() > first + 1 || is_changed[t])
        for (std::size_t p = first; p < pieces.size(); ++p)
          cut.smallest_angle = std::min(cut.smallest_angle, smallest_angle(pieces[p].corners));
    }
    mesh.triangles = std::move(pieces);
    cut.mesh       = std::move(mesh);
    return cut;
  }

private:
  /// Where a corner stands: 2 m on line m, 2 m + 1 between the lines m and m + 1.
  int band(const LatticeCorner &corner) const
  {
    const double c = mesh.places[at(corner.vertex)](axis) - level;
    const int m    = on_line[at(corner.vertex)] ? 2 * static_cast<int>(std::round(c))
                                                : 2 * static_cast<int>(std::floor(c)) + 1;
    return m + 2 * corner.offset(axis);
  }

  /// The number of the first line strictly between two bands, times two; the lower band where there
  /// is none.
  static int line_between(const int one, const int other)
  {
    const int low = std::min(one, other), high = std::max(one, other),
              line = low + 2 - (low % 2 == 0 ? 0 : 1);
    return line < high ? line : low;
  }

  static bool is_crossed(const int one, const int other)
  {
    return line_between(one, other) != std::min(one, other);
  }

  void put_on_line(const int v)
  {
    double &c      = mesh.places[at(v)](axis);
    c              = level + std::round(c - level);
    on_line[at(v)] = 1;
  }

  /// No triangle reaches beyond two lines, and no curve crosses a line beside its chord.
  bool can_be_cut() const
  {
    for (const LatticeTriangle &triangle : mesh.triangles)
    {
      const int a = band(triangle.corners[0]), b = band(triangle.corners[1]),
                c   = band(triangle.corners[2]);
      const int low = std::min({a, b, c}), high = std::max({a, b, c});
      if (const int line = line_between(low, high); line != low && is_crossed(line, high))
        return false;
    }
    for (const auto &[edge, bulge] : mesh.bulges)
    {
      const LatticeCorner from{edge[0], {0, 0}}, to{edge[1], {edge[2], edge[3]}};
      const double a = mesh.at(from)(axis) - level, b = mesh.at(to)(axis) - level,
                   control = 0.5 * (a + b) + 2. * bulge(axis);
      // The curve stays between its ends and its control point.
      const double slack = meshes::image_tolerance;
      const bool beyond  = std::floor(std::min(a, b) + slack) > control + slack ||
                          std::ceil(std::max(a, b) - slack) < control - slack;
      if (beyond)
        return false;
    }
    return true;
  }

  /// Free vertices near to a line that one of their edges crosses, the nearest first.
  std::vector<int> near_vertices() const
  {
    std::vector<std::pair<double, int>> found;
    for (std::size_t v = 0; v < mesh.places.size(); ++v)
      if (around.is_free[v] && !on_line[v] && is_near(static_cast<int>(v)))
      {
        const double c = mesh.places[v](axis) - level;
        found.emplace_back(std::abs(c - std::round(c)), static_cast<int>(v));
      }
    std::sort(found.begin(), found.end());
    std::vector<int> vertices;
    for (const auto &[distance, v] : found)
      vertices.push_back(v);
    return vertices;
  }

  bool is_near(const int v) const
  {
    for (const std::size_t t : around.triangles_at[at(v)])
      for (const LatticeCorner &mine : mesh.triangles[t].corners)
        for (const LatticeCorner &other : mesh.triangles[t].corners)
        {
          const int a = band(mine), b = band(other);
          if (mine.vertex != v || !is_crossed(a, b))
            continue;
          const double line = 0.5 * line_between(a, b) + level, mine_at = mesh.at(mine)(axis),
                       other_at = mesh.at(other)(axis);
          if (std::abs(line - mine_at) < near * std::abs(other_at - mine_at))
            return true;
        }
    return false;
  }

  void move_if_fair(const int v)
  {
    if (!is_near(v)) // its neighbour was moved
      return;
    const auto worst = [&]
    {
      double angle = 180.;
      for (const std::size_t t : around.triangles_at[at(v)])
        angle = std::min(angle, smallest_angle(mesh.triangles[t].corners));
      return angle;
    };
    const double before             = worst();
    const Eigen::RowVector2d stayed = mesh.places[at(v)];
    put_on_line(v);
    if (worst() < std::min(before, fair_angle))
    {
      mesh.places[at(v)] = stayed;
      on_line[at(v)]     = 0;
      return;
    }
    for (const std::size_t t : around.triangles_at[at(v)])
      is_changed[t] = 1;
  }

  /// [degrees], negative where the corners run clockwise.
  double smallest_angle(const std::array<LatticeCorner, 3> &corners) const
  {
    std::array<Eigen::Vector2d, 3> x;
    for (std::size_t k = 0; k < 3; ++k)
      x[k] = (mesh.at(corners[k]) * mesh.lattice.vectors).transpose();
    double smallest = 180.;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Eigen::Vector2d u = x[(k + 1) % 3] - x[k], v = x[(k + 2) % 3] - x[k];
      smallest = std::min(smallest, std::atan2(u(0) * v(1) - u(1) * v(0), u.dot(v)));
    }
    return smallest * 180. / M_PI;
  }

  /// The vertex where the edge between two corners crosses the line: one for all its images.
  LatticeCorner crossing(const LatticeCorner &from, const LatticeCorner &to)
  {
    const LatticeEdge edge = edge_between(from, to);
    const bool is_forwards = from.vertex == edge[0] && to.vertex == edge[1] &&
                             to.offset(0) - from.offset(0) == edge[2] &&
                             to.offset(1) - from.offset(1) == edge[3];
    const LatticeCorner &first = is_forwards ? from : to;
    const auto [place, is_new] = new_vertices.emplace(edge, static_cast<int>(mesh.places.size()));
    if (is_new)
      split_edge(edge);
    return {place->second, first.offset};
  }

  void split_edge(const LatticeEdge &edge)
  {
    const LatticeCorner from{edge[0], {0, 0}}, to{edge[1], {edge[2], edge[3]}};
    const Eigen::RowVector2d a = mesh.at(from), b = mesh.at(to);
    const double line = 0.5 * line_between(band(from), band(to)) + level;
    const auto bulge  = mesh.bulges.find(edge);
    const Eigen::RowVector2d sagitta =
      bulge == mesh.bulges.end() ? Eigen::RowVector2d(0., 0.) : bulge->second;
    const double along   = crossing_of(a(axis) - line, b(axis) - line, sagitta(axis));
    Eigen::RowVector2d x = (1. - along) * a + along * b + 4. * along * (1. - along) * sagitta;
    x(axis)              = line;
    const LatticeCorner middle{static_cast<int>(mesh.places.size()), {0, 0}};
    mesh.places.push_back(x);
    on_line.push_back(1);
    if (bulge == mesh.bulges.end())
      return;
    // Halves of a parabola are parabolas.
    mesh.bulges.erase(bulge);
    mesh.bulges[edge_between(from, middle)] = along * along * sagitta;
    mesh.bulges[edge_between(middle, to)]   = (1. - along) * (1. - along) * sagitta;
  }

  /// Where (1 − t) a + t b + 4 t (1 − t) s is zero, a and b of different sign.
  static double crossing_of(const double a, const double b, const double s)
  {
    double low = 0., high = 1.;
    double t = a / (a - b);
    for (int k = 0; k < 60 && s != 0.; ++k) // once in between, by bisection
    {
      const double value                      = (1. - t) * a + t * b + 4. * t * (1. - t) * s;
      ((value > 0.) == (a > 0.) ? low : high) = t;
      t                                       = 0.5 * (low + high);
    }
    return t;
  }

  void split(const LatticeTriangle &triangle, std::vector<LatticeTriangle> &pieces)
  {
    const auto &corners = triangle.corners;
    const auto add = [&](const LatticeCorner &a, const LatticeCorner &b, const LatticeCorner &c) {
      pieces.push_back({{a, b, c}, triangle.material, triangle.group});
    };
    const auto crosses = [&](const std::size_t k)
    { return is_crossed(band(corners[k]), band(corners[(k + 1) % 3])); };
    std::size_t n = 0, lone = 0;
    for (std::size_t k = 0; k < 3; ++k)
      n += crosses(k) ? 1 : 0;
    if (n == 0)
      return add(corners[0], corners[1], corners[2]);
    if (n == 1)
    {
      while (!crosses(lone))
        ++lone;
      const LatticeCorner &a = corners[lone], &b = corners[(lone + 1) % 3],
                          &c      = corners[(lone + 2) % 3];
      const LatticeCorner on_edge = crossing(a, b);
      add(a, on_edge, c);
      return add(on_edge, b, c);
    }
    while (!crosses(lone) || !crosses((lone + 2) % 3)) // both edges of the lone corner are crossed
      ++lone;
    const LatticeCorner &a = corners[lone], &b = corners[(lone + 1) % 3],
                        &c = corners[(lone + 2) % 3];
    const LatticeCorner ab = crossing(a, b), ca = crossing(c, a);
    add(a, ab, ca);
    const auto worse =
      [&](const std::array<LatticeCorner, 3> &one, const std::array<LatticeCorner, 3> &other)
    { return std::min(smallest_angle(one), smallest_angle(other)); };
    if (worse({ab, b, c}, {ab, c, ca}) >= worse({ab, b, ca}, {b, c, ca}))
    {
      add(ab, b, c);
      return add(ab, c, ca);
    }
    add(ab, b, ca);
    add(b, c, ca);
  }

  const int axis;
  const double level;
  const Surroundings &around;
  LatticeTriangles mesh;
  std::vector<char> on_line, is_changed; // vertices, triangles
  std::map<LatticeEdge, int> new_vertices;
};
} // namespace

std::optional<LineCut> cut_along(const LatticeTriangles &mesh, const int axis,
                                 const std::vector<double> &levels)
{
  const Surroundings around = surroundings_of(mesh);
  std::optional<LineCut> best;
  for (const double level : levels)
    if (auto cut = Cutter(mesh, around, axis, level).run();
        cut && (!best || cut->smallest_angle > best->smallest_angle))
      best = std::move(cut);
  return best;
}
} // namespace homespun::homogenization
