// SPDX-License-Identifier: MIT
#include "meshes/garment/filled_holes.h"

#include "meshes/plain/cross.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>
#include <utility>
#include <vector>

namespace homespun::meshes
{
namespace
{
/// Three vertices of a rim that follow each other are cut off where they turn to the left by this
/// much at least, 2 area / longest side^2: not where only rounding makes a line turn.
constexpr double flat = 1e-9;

/// A hole whose vertices are cut off one by one (ear clipping).
///
/// An ear that holds no other vertex, not on its border either, leaves a polygon of the same kind,
/// and every polygon has one; vertices within straight parts of a rim stay and get triangles.
class Hole
{
public:
  Hole(const TriangleMesh &mesh, std::vector<int> counter_clockwise)
      : mesh(mesh)
      , rim(std::move(counter_clockwise))
  {
  }

  /// Adds its triangles to a list.
  void fill(std::vector<std::array<int, 3>> &triangles)
  {
    while (rim.size() >= 3)
    {
      const std::size_t k = best_ear();
      triangles.push_back(ear(k));
      rim.erase(rim.begin() + static_cast<std::ptrdiff_t>(k));
      if (rim.size() == 2)
        break;
    }
  }

private:
  std::array<int, 3> ear(const std::size_t k) const
  {
    const std::size_t n = rim.size();
    return {rim[(k + n - 1) % n], rim[k], rim[(k + 1) % n]};
  }

  Eigen::RowVector2d x(const int v) const
  {
    return mesh.vertices.row(v);
  }

  double turn(const std::array<int, 3> &corners) const
  {
    const Eigen::RowVector2d a = x(corners[1]) - x(corners[0]), b = x(corners[2]) - x(corners[1]);
    return cross(a, b) / std::max({a.squaredNorm(), b.squaredNorm(), (a + b).squaredNorm()});
  }

  bool holds_another(const std::array<int, 3> &corners) const
  {
    return std::any_of(rim.begin(), rim.end(),
                       [&](const int v)
                       {
                         if (std::find(corners.begin(), corners.end(), v) != corners.end())
                           return false;
                         for (std::size_t k = 0; k < 3; ++k)
                         {
                           const Eigen::RowVector2d from = x(corners[k]),
                                                    side = x(corners[(k + 1) % 3]) - from;
                           if (cross(side, x(v) - from) < -flat * side.squaredNorm())
                             return false;
                         }
                         return true;
                       });
  }

  /// That which is farthest from flat.
  std::size_t best_ear() const
  {
    std::vector<std::pair<double, std::size_t>> ears;
    for (std::size_t k = 0; k < rim.size(); ++k)
      if (const double found = turn(ear(k)); found > flat)
        ears.emplace_back(found, k);
    std::sort(ears.begin(), ears.end(), std::greater<>());
    for (const auto &[found, k] : ears)
      if (rim.size() == 3 || !holds_another(ear(k)))
        return k;
    std::ostringstream text;
    text << "fine cloth: the rim of a hole of the cell crosses or touches itself near ("
         << x(rim[0])(0) << ", " << x(rim[0])(1)
         << ") m; expected holes whose rims do not: draw the cell anew there";
    throw BadInput(text.str());
  }

  const TriangleMesh &mesh;
  std::vector<int> rim;
};

double signed_area(const TriangleMesh &mesh, const std::vector<int> &loop)
{
  double twice = 0.;
  for (std::size_t k = 0; k < loop.size(); ++k)
    twice += cross(Eigen::RowVector2d(mesh.vertices.row(loop[k])),
                   Eigen::RowVector2d(mesh.vertices.row(loop[(k + 1) % loop.size()])));
  return 0.5 * twice;
}
} // namespace

TriangleMesh filled_holes(const TriangleMesh &mesh)
{
  std::vector<std::array<int, 3>> added;
  for (std::vector<int> loop : boundary_loops(mesh))
    if (signed_area(mesh, loop) < 0.)
    {
      std::reverse(loop.begin(), loop.end());
      Hole(mesh, std::move(loop)).fill(added);
    }
  TriangleMesh filled = mesh;
  const int n = mesh.n_triangles(), n_added = static_cast<int>(added.size());
  filled.triangles.conservativeResize(n + n_added, 3);
  filled.material.conservativeResize(n + n_added);
  for (int t = 0; t < n_added; ++t)
  {
    const auto [a, b, c] = added[at(t)];
    filled.triangles.row(n + t) << a, b, c;
    filled.material(n + t) = hole;
  }
  return filled;
}
} // namespace homespun::meshes
