// SPDX-License-Identifier: MIT
#include "meshes/plain/drawn_lattice.h"

#include "meshes/plain/cross.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::meshes
{
namespace
{
using Vector  = Eigen::RowVector2d;
using Polygon = std::vector<Vector>;

/// a1 nearest to the x axis and along it, of two as near the one that rises; a1 x a2 > 0.
Lattice ordered(Vector one, Vector other)
{
  for (Vector *const vector : {&one, &other})
    if ((*vector)(0) < 0.)
      *vector *= -1.;
  const double rise = std::abs(one(1)) / one.norm(), of_other = std::abs(other(1)) / other.norm();
  // Where the drawing is symmetric about the x axis, rounding must not choose.
  if (of_other < rise - image_tolerance || (of_other < rise + image_tolerance && other(1) > one(1)))
    std::swap(one, other);
  Lattice lattice;
  lattice.vectors << one, other;
  if (lattice.vectors.determinant() < 0.)
    lattice.vectors.row(1) *= -1.;
  lattice.vectors.array() += 0.; // prints 0, not -0
  return lattice;
}

/// reduced() of two vectors.
Lattice reduced(Vector one, Vector other)
{
  while (true)
  {
    if (one.norm() > other.norm())
      std::swap(one, other);
    const double times = std::round(one.dot(other) / one.squaredNorm());
    if (times == 0. || (other - times * one).norm() >= other.norm() * (1. - 1e-9))
      return ordered(one, other);
    other -= times * one;
  }
}

/// Counter-clockwise, without points on its sides.
Polygon hull_of(const TriangleMesh &mesh)
{
  Polygon points;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    points.emplace_back(mesh.vertices.row(v));
  std::sort(points.begin(), points.end(),
            [](const Vector &a, const Vector &b)
            { return a(0) != b(0) ? a(0) < b(0) : a(1) < b(1); });
  Polygon hull;
  for (int side = 0; side < 2; ++side) // below, then above
  {
    const std::size_t first = hull.size();
    for (const Vector &x : points)
    {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], x - hull.back()) <= 0.)
        hull.pop_back();
      hull.push_back(x);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// A hull whose flattest corners are left out, one after the other, as long as none of the points
/// that were left out lies farther outside than the tolerance, and more corners than `fewest` are
/// there.
Polygon without_flat_corners(const Polygon &hull, const double tolerance, const std::size_t fewest)
{
  std::vector<std::size_t> kept(hull.size());
  for (std::size_t k = 0; k < kept.size(); ++k)
    kept[k] = k;
  const auto outside = [&](const std::size_t k)
  {
    const std::size_t before = kept[(k + kept.size() - 1) % kept.size()],
                      after  = kept[(k + 1) % kept.size()];
    const Vector side        = (hull[after] - hull[before]).normalized();
    double farthest          = 0.;
    for (std::size_t p = (before + 1) % hull.size(); p != after; p = (p + 1) % hull.size())
      farthest = std::max(farthest, std::abs(cross(side, hull[p] - hull[before])));
    return farthest;
  };
  while (kept.size() > std::max<std::size_t>(fewest, 3))
  {
    std::size_t flattest = 0;
    double least         = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kept.size(); ++k)
      if (const double its = outside(k); its < least)
      {
        least    = its;
        flattest = k;
      }
    if (least > tolerance)
      break;
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(flattest));
  }
  Polygon corners;
  for (const std::size_t k : kept)
    corners.push_back(hull[k]);
  return corners;
}

double area_of(const Polygon &polygon)
{
  double twice = 0.;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    twice += cross(polygon[k], polygon[(k + 1) % polygon.size()]);
  return 0.5 * twice;
}

bool is_centrally_symmetric(const Polygon &corners, const double tolerance)
{
  const std::size_t half = corners.size() / 2;
  for (std::size_t k = 1; k < half; ++k)
    if ((corners[k] + corners[k + half] - corners[0] - corners[half]).norm() > 2. * tolerance)
      return false;
  return true;
}

/// The lattice of a parallelogram: its sides.
Frame frame_of_parallelogram(const Polygon &corners)
{
  return {ordered(corners[1] - corners[0], corners[2] - corners[1]), {{1, 0}, {0, 1}}};
}

/// The lattice of a hexagon: the two shortest of its translations of a side onto the opposite one.
Frame frame_of_hexagon(const Polygon &corners)
{
  std::vector<Vector> translations;
  for (std::size_t k = 0; k < 3; ++k)
    translations.push_back(corners[(k + 4) % 6] - corners[k]);
  std::stable_sort(translations.begin(), translations.end(),
                   [](const Vector &a, const Vector &b)
                   { return a.norm() < b.norm() * (1. - 1e-9); });
  Frame frame{ordered(translations[0], translations[1]), {}};
  for (const Vector &translation : translations)
    frame.pairs.emplace_back(frame.lattice.fractional(translation).array().round().cast<int>());
  return frame;
}
} // namespace

std::vector<Frame> frames_of(const TriangleMesh &mesh, const double tolerance)
{
  std::vector<Frame> frames;
  const Polygon corners = without_flat_corners(hull_of(mesh), tolerance, 4);
  if ((corners.size() == 4 || corners.size() == 6) && is_centrally_symmetric(corners, tolerance))
    frames.push_back(corners.size() == 4 ? frame_of_parallelogram(corners)
                                         : frame_of_hexagon(corners));
  const Vector size = mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  Frame box{{}, {{1, 0}, {0, 1}}};
  box.lattice.vectors << size(0), 0., 0., size(1);
  if (size.minCoeff() > 0. &&
      (frames.empty() ||
       (box.lattice.vectors - frames[0].lattice.vectors).cwiseAbs().maxCoeff() > tolerance))
    frames.push_back(box);
  return frames;
}

std::vector<Frame> frame_meant(const TriangleMesh &mesh)
{
  const Polygon hull  = hull_of(mesh);
  const double nearly = 0.05 * std::sqrt(std::abs(area_of(hull)));
  const Polygon four  = without_flat_corners(hull, nearly, 4);
  if (four.size() != 4 || !is_centrally_symmetric(four, nearly))
    return {};
  return {frame_of_parallelogram(four)};
}

Lattice reduced(const Lattice &lattice)
{
  return reduced(lattice.vectors.row(0), lattice.vectors.row(1));
}

bool is_same_lattice(const Lattice &one, const Lattice &other)
{
  const Eigen::Matrix2d change = one.vectors * other.vectors.inverse();
  return (change - Eigen::Matrix2d(change.array().round())).norm() < 1e-3 &&
         std::abs(std::abs(change.determinant()) - 1.) < 1e-3;
}

std::vector<Lattice> lattices_of_outline(const TriangleMesh &mesh, const double tolerance)
{
  const std::vector<int> loop = outline(mesh);
  const std::size_t n = loop.size(), half = n / 2;
  if (n % 2 == 1)
    return {}; // each side has an image with as many edges
  const auto at   = [&](const std::size_t k) -> Vector { return mesh.vertices.row(loop[k % n]); };
  const auto edge = [&](const std::size_t k) -> Vector { return at(k + 1) - at(k); };
  std::vector<char> is_corner(n, 0);
  std::vector<std::size_t> corners;
  for (std::size_t k = 0; k < n; ++k)
    if (std::abs(cross(edge(k + n - 1).normalized(), edge(k).normalized())) > 1e-5)
    {
      is_corner[k] = 1;
      corners.push_back(k);
    }
  // Sides end at corners: too many of them are no drawing of a side, but noise.
  if (corners.size() > 600)
    return {};
  /// Whether the piece from i to j is carried onto the one from i + n/2 to j + n/2, backwards.
  const auto is_carried = [&](const std::size_t i, const std::size_t j)
  {
    const Vector translation = at(j + half) - at(i);
    for (std::size_t s = 1; s <= j - i; ++s)
      if ((at(i + s) + translation - at(j + half - s)).norm() > 2. * tolerance)
        return false;
    return true;
  };
  std::vector<std::vector<char>> carried(n); // [i][length], by need
  const auto carries = [&](const std::size_t i, const std::size_t j)
  {
    std::vector<char> &row = carried[i % n];
    row.resize(half + 1, 2);
    char &known = row[j - i];
    if (known == 2)
      known = is_carried(i, j) ? 1 : 0;
    return known == 1;
  };
  double enclosed = 0.;
  for (std::size_t k = 0; k < n; ++k)
    enclosed += 0.5 * cross(at(k), at(k + 1));

  std::vector<Lattice> found;
  const auto add = [&](const Vector &one, const Vector &other)
  {
    if (std::abs(std::abs(cross(one, other)) - enclosed) > 1e-6 * enclosed)
      return;
    const Lattice lattice = reduced(one, other);
    for (const Lattice &known : found)
      if (is_same_lattice(known, lattice))
        return;
    found.push_back(lattice);
  };
  std::vector<std::size_t> ends = corners; // once around, and once more
  for (const std::size_t corner : corners)
    ends.push_back(corner + n);
  for (const std::size_t i : corners)
  {
    if (i >= half || !is_corner[(i + half) % n])
      continue;
    for (const std::size_t j : ends)
    {
      if (j <= i || j >= i + half || !is_corner[(j + half) % n] || !carries(i, j))
        continue;
      for (const std::size_t k : ends)
      {
        if (k <= j || k > i + half || !is_corner[(k + half) % n] || !carries(j, k) ||
            (k < i + half && !carries(k, i + half)))
          continue;
        add(at(j + half) - at(i), at(k + half) - at(j));
      }
    }
  }
  return found;
}
} // namespace homespun::meshes
