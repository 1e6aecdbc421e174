// SPDX-License-Identifier: MIT
#include "shell/contact/closed_surface.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/triangle_area.h"
#include "shell/algebra/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

namespace homespun::shell
{
namespace
{
constexpr int leaf_size = 4;

// A crossing may miss both faces of an edge by round-off; faces reach over their edges by this
// part.
constexpr double overlap = 1e-9;

/// Nearest point of a triangle in barycentric coordinates, and whether it lies on the face (0), the
/// edge opposite to corner k (1 + k) or on corner k (4 + k). Regions as in Ericson, "Real-time
/// collision detection" (2005), section 5.1.5.
struct NearestOnTriangle
{
  Eigen::Vector3d point;
  int feature = 0;
};

NearestOnTriangle nearest_on_triangle(const Eigen::Vector3d &p, const Eigen::Vector3d &a,
                                      const Eigen::Vector3d &b, const Eigen::Vector3d &c)
{
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
               d6 = ac.dot(cp);
  if (d1 <= 0. && d2 <= 0.)
    return {a, 4};
  if (d3 >= 0. && d4 <= d3)
    return {b, 5};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0. && d1 >= 0. && d3 <= 0.)
    return {a + d1 / (d1 - d3) * ab, 3};
  if (d6 >= 0. && d5 <= d6)
    return {c, 6};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0. && d2 >= 0. && d6 <= 0.)
    return {a + d2 / (d2 - d6) * ac, 2};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0. && d4 - d3 >= 0. && d5 - d6 >= 0.)
    return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 1};
  return {a + (vb * ab + vc * ac) / (va + vb + vc), 0};
}
} // namespace

ClosedSurface::ClosedSurface(const meshes::SpacePoints &vertices,
                             const meshes::Triangles &triangles, const std::string &name)
    : x(vertices)
    , t(triangles)
    , face_normals(triangles.rows(), 3)
    , edge_normals(3 * triangles.rows(), 3)
    , vertex_normals(meshes::SpacePoints::Zero(vertices.rows(), 3))
    , order(index(static_cast<int>(triangles.rows())))
{
  std::vector<std::string> faults;
  const auto fault = [&](const std::string &message)
  {
    if (faults.size() < 10)
      faults.push_back(name + ": " + message);
  };
  const int n = static_cast<int>(x.rows()), m = static_cast<int>(t.rows());
  if (m == 0)
    fault("has no triangles; expected a closed surface");
  for (int v = 0; v < n; ++v)
    if (!x.row(v).allFinite())
      fault("vertex " + std::to_string(v) + " has a coordinate that is not finite");
  for (int f = 0; f < m; ++f)
    if (t.row(f).minCoeff() < 0 || t.row(f).maxCoeff() >= n)
      fault("triangle " + std::to_string(f) + " has a vertex out of range; expected 0 ... " +
            std::to_string(n - 1));
  if (!faults.empty())
    throw meshes::BadInput(faults);

  std::map<std::array<int, 2>, int> sides; // directed edge: triangle
  double volume                = 0.;
  const Eigen::Vector3d centre = x.colwise().mean().transpose();
  for (int f = 0; f < m; ++f)
  {
    const Eigen::Vector3d a = corner(f, 0) - centre, b = corner(f, 1) - centre,
                          c = corner(f, 2) - centre, normal = (b - a).cross(c - a);
    volume += a.dot(b.cross(c)) / 6.;
    if (!meshes::triangle_area<3>(x, t.row(f)).is_there())
    {
      fault("triangle " + std::to_string(f) + " has no area; remove it");
      continue;
    }
    face_normals.row(f) = normal.normalized().transpose();
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d one = (corner(f, k + 1) - corner(f, k)).normalized(),
                            two = (corner(f, k + 2) - corner(f, k)).normalized();
      vertex_normals.row(t(f, k)) +=
        std::atan2(one.cross(two).norm(), one.dot(two)) * face_normals.row(f);
      const std::array<int, 2> edge{t(f, (k + 1) % 3), t(f, (k + 2) % 3)};
      if (!sides.insert({edge, f}).second)
        fault("edge (" + std::to_string(edge[0]) + ", " + std::to_string(edge[1]) +
              ") is traversed the same way by triangles " + std::to_string(sides[edge]) + " and " +
              std::to_string(f) + "; expected two triangles that traverse it in opposite ways");
    }
  }
  for (const auto &[edge, f] : sides)
    if (sides.find({edge[1], edge[0]}) == sides.end())
      fault("edge (" + std::to_string(edge[0]) + ", " + std::to_string(edge[1]) +
            ") belongs to triangle " + std::to_string(f) +
            " only; expected a closed surface: fill the hole");
  if (faults.empty() && !(volume > 0.))
  {
    std::ostringstream text;
    text << "encloses a volume of " << volume
         << " m^3; expected a positive one: normals point inwards, reverse all triangles";
    fault(text.str());
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);

  // Where faces lie back to back a pseudo-normal vanishes; that of a face stands in for it.
  const auto normalized_or = [](const Eigen::RowVector3d &sum, const Eigen::RowVector3d &other)
  { return Eigen::RowVector3d(sum.norm() > 1e-9 ? Eigen::RowVector3d(sum.normalized()) : other); };
  for (int f = 0; f < m; ++f)
    for (int k = 0; k < 3; ++k)
    {
      const int other = sides[{t(f, (k + 2) % 3), t(f, (k + 1) % 3)}];
      edge_normals.row(3 * f + k) =
        normalized_or(face_normals.row(f) + face_normals.row(other), face_normals.row(f));
      vertex_normals.row(t(f, k)) = normalized_or(vertex_normals.row(t(f, k)), face_normals.row(f));
    }
  std::iota(order.begin(), order.end(), 0);
  nodes.reserve(index(2 * m));
  build(0, m);
}

int ClosedSurface::build(const int begin, const int end)
{
  const int node = static_cast<int>(nodes.size());
  nodes.emplace_back();
  Eigen::AlignedBox3d box, centres;
  const auto centre = [this](const int f) -> Eigen::Vector3d
  { return (corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3.; };
  for (int i = begin; i < end; ++i)
  {
    for (int k = 0; k < 3; ++k)
      box.extend(corner(order[index(i)], k));
    centres.extend(centre(order[index(i)]));
  }
  nodes[index(node)].box = box;
  if (end - begin <= leaf_size)
  {
    nodes[index(node)].first = begin;
    nodes[index(node)].n     = end - begin;
    return node;
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                   [&](const int a, const int b)
                   {
                     const double xa = centre(a)(axis), xb = centre(b)(axis);
                     return xa < xb || (xa == xb && a < b);
                   });
  build(begin, middle);
  const int right          = build(middle, end);
  nodes[index(node)].right = right;
  return node;
}

std::optional<SurfacePoint> ClosedSurface::nearest(const Eigen::Vector3d &point,
                                                   const double within) const
{
  // Inside, however deep, there is always an answer.
  double best =
    nodes.front().box.contains(point) ? std::numeric_limits<double>::infinity() : within * within;
  int face = -1;
  NearestOnTriangle found;
  std::array<int, 128> stack; // the tree halves: its depth is below 64
  int n_stack      = 0;
  stack[0]         = 0;
  n_stack          = 1;
  const auto away2 = [&](const int node)
  { return nodes[index(node)].box.squaredExteriorDistance(point); };
  while (n_stack > 0)
  {
    const int current    = stack[index(--n_stack)];
    const TreeNode &node = nodes[index(current)];
    if (!(away2(current) <= best))
      continue;
    if (node.right < 0)
    {
      for (int i = node.first; i < node.first + node.n; ++i)
      {
        const int f          = order[index(i)];
        const auto candidate = nearest_on_triangle(point, corner(f, 0), corner(f, 1), corner(f, 2));
        const double squared = (point - candidate.point).squaredNorm();
        if (squared < best || (face < 0 && squared <= best))
        {
          best  = squared;
          face  = f;
          found = candidate;
        }
      }
      continue;
    }
    const int left = current + 1, right = node.right;
    const bool left_first   = away2(left) <= away2(right);
    stack[index(n_stack++)] = left_first ? right : left;
    stack[index(n_stack++)] = left_first ? left : right;
  }
  if (face < 0)
    return std::nullopt;
  const Eigen::Vector3d pseudo_normal =
    (found.feature == 0   ? Eigen::RowVector3d(face_normals.row(face))
     : found.feature <= 3 ? Eigen::RowVector3d(edge_normals.row(3 * face + found.feature - 1))
                          : Eigen::RowVector3d(vertex_normals.row(t(face, found.feature - 4))))
      .transpose();
  const Eigen::Vector3d away = point - found.point;
  const double distance      = away.norm();
  const double sign          = away.dot(pseudo_normal) < 0. ? -1. : 1.;
  if (sign * distance > within)
    return std::nullopt;
  // On the surface, to round-off, the direction of `away` means nothing.
  const double size = nodes.front().box.diagonal().norm() + point.norm();
  if (distance <= 1e-14 * size)
    return SurfacePoint{sign * distance, pseudo_normal};
  return SurfacePoint{sign * distance, sign / distance * away};
}

std::optional<SurfaceEntry> ClosedSurface::first_entry(const Eigen::Vector3d &from,
                                                       const Eigen::Vector3d &to) const
{
  const Eigen::Vector3d way = to - from;
  std::optional<SurfaceEntry> first;
  double best = 1.;
  std::array<int, 128> stack;
  stack[0]    = 0;
  int n_stack = 1;
  while (n_stack > 0)
  {
    const int current    = stack[index(--n_stack)];
    const TreeNode &node = nodes[index(current)];
    // Slabs, over the part of the segment that is still asked for.
    double enter = 0., leave = best;
    for (int i = 0; i < 3 && enter <= leave; ++i)
    {
      const double slack = overlap * (node.box.max()(i) - node.box.min()(i) + std::abs(way(i)));
      const double low   = node.box.min()(i) - slack - from(i),
                   high  = node.box.max()(i) + slack - from(i);
      if (way(i) == 0.)
      {
        if (low > 0. || high < 0.)
          leave = -1.;
        continue;
      }
      enter = std::max(enter, std::min(low / way(i), high / way(i)));
      leave = std::min(leave, std::max(low / way(i), high / way(i)));
    }
    if (!(enter <= leave))
      continue;
    if (node.right >= 0)
    {
      stack[index(n_stack++)] = node.right;
      stack[index(n_stack++)] = current + 1;
      continue;
    }
    for (int i = node.first; i < node.first + node.n; ++i)
    {
      const int f                  = order[index(i)];
      const Eigen::Vector3d normal = face_normals.row(f).transpose(), a = corner(f, 0),
                            e1 = corner(f, 1) - a, e2 = corner(f, 2) - a;
      const double speed = normal.dot(way);
      if (!(speed < 0.))
        continue;
      const double part = normal.dot(a - from) / speed;
      if (!(part >= 0. && part <= best))
        continue;
      const Eigen::Vector3d hit = from + part * way;
      const double twice_area = normal.dot(e1.cross(e2)), u = normal.dot((hit - a).cross(e2)),
                   v = normal.dot(e1.cross(hit - a));
      if (u < -overlap * twice_area || v < -overlap * twice_area ||
          u + v > (1. + overlap) * twice_area)
        continue;
      best  = part;
      first = SurfaceEntry{hit, normal, part};
    }
  }
  return first;
}

std::size_t ClosedSurface::bytes() const
{
  return nodes.size() * sizeof(TreeNode) + order.size() * sizeof(int) +
         static_cast<std::size_t>(t.size()) * sizeof(int) +
         static_cast<std::size_t>(x.size() + face_normals.size() + edge_normals.size() +
                                  vertex_normals.size()) *
           sizeof(double);
}
} // namespace homespun::shell
