// SPDX-License-Identifier: MIT
#include "homogenization/bracket/isometric_bending.h"

#include "homogenization/bracket/plate.h"
#include "meshes/plain/drawn_lattice.h"
#include "meshes/plain/index.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// A function of the offset that comes back after a period, linear between its breaks and free to
/// jump there.
class PiecewiseLinear
{
public:
  /// @param offsets of the breaks, any; those within a billionth of the period are one
  PiecewiseLinear(const double period, std::vector<double> offsets)
      : period(period)
      , least(1e-9 * period)
  {
    for (double &offset : offsets)
      offset -= period * std::floor(offset / period);
    std::sort(offsets.begin(), offsets.end());
    for (const double offset : offsets)
      if (breaks.empty() ||
          (offset > breaks.back() + least && offset < breaks.front() + period - least))
        breaks.push_back(offset);
    first.assign(breaks.size(), 0.);
    last = first;
  }

  /// Adds a hat: zero up to the first offset, height at the second, zero from the third on, which
  /// are all breaks.
  void add_hat(const std::array<double, 3> &offsets, const double height)
  {
    const auto hat = [&](const double s, const bool rises)
    {
      const double part = rises ? (s - offsets[0]) / (offsets[1] - offsets[0])
                                : (offsets[2] - s) / (offsets[2] - offsets[1]);
      return height * std::clamp(part, 0., 1.);
    };
    std::size_t k = nearest(offsets[0]);
    for (double s = offsets[0]; s < offsets[2] - least; k = (k + 1) % breaks.size())
    {
      const double end = s + width(k);
      const bool rises = 0.5 * (s + end) < offsets[1];
      first[k] += hat(s, rises);
      last[k] += hat(end, rises);
      s = end;
    }
  }

  /// 1 / mean of 1 / f.
  double harmonic_mean() const
  {
    double sum = 0.;
    for (std::size_t k = 0; k < breaks.size(); ++k)
    {
      const double most = std::max(first[k], last[k]);
      if (!(most > 0.))
        return 0.;
      const double ratio = std::min(first[k], last[k]) / most - 1.;
      // integral of 1 / f, f linear: log(b / a) / (b − a).
      sum += width(k) / most * (ratio < 0. ? std::log1p(ratio) / ratio : 1.);
    }
    return period / sum;
  }

private:
  double width(const std::size_t k) const
  {
    return k + 1 < breaks.size() ? breaks[k + 1] - breaks[k] : breaks[0] + period - breaks[k];
  }

  std::size_t nearest(const double offset) const
  {
    const double place = offset - period * std::floor(offset / period);
    const auto after   = std::upper_bound(breaks.begin(), breaks.end(), place + least);
    return after == breaks.begin() || place > breaks.front() + period - least
             ? 0
             : at(after - breaks.begin() - 1);
  }

  const double period, least;
  std::vector<double> breaks, first, last; ///< values where a piece begins and where it ends
};
} // namespace

IsometricBending
isometric_bending(const PlateMesh &mesh, const meshes::Lattice &lattice,
                  const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
                  const std::array<int, 2> &ruling)
{
  const Eigen::Vector2d along = lattice.vectors.transpose() * Eigen::Vector2d(ruling[0], ruling[1]);
  const double length         = along.norm();
  Eigen::Vector2d n(-along(1) / length, along(0) / length);
  if (n(1) < 0. || (n(1) == 0. && n(0) < 0.))
    n = -n;
  const Eigen::Vector3d K = curvature_across(n);
  std::vector<double> offsets;
  for (const PlateTriangle &triangle : mesh.triangles)
    for (const Eigen::Vector2d &corner : triangle.corners)
      offsets.push_back(n.dot(corner));
  PiecewiseLinear mean(lattice.area() / length, offsets);
  for (const PlateTriangle &triangle : mesh.triangles)
  {
    std::array<double, 3> its;
    for (std::size_t k = 0; k < 3; ++k)
      its[k] = n.dot(triangle.corners[k]);
    std::sort(its.begin(), its.end());
    const Eigen::Vector2d a = triangle.corners[1] - triangle.corners[0],
                          b = triangle.corners[2] - triangle.corners[0];
    const double chord      = (a(0) * b(1) - a(1) * b(0)) / (its[2] - its[0]); // the longest
    mean.add_hat(its,
                 K.dot(bending_stiffness_of_material[at(triangle.material)] * K) * chord / length);
  }
  return {ruling, std::atan2(n(1), n(0)), mean.harmonic_mean()};
}

std::vector<std::array<int, 2>> short_rulings(const meshes::Lattice &lattice)
{
  constexpr int most = 4;
  // The shortest basis in that of the lattice.
  const Eigen::Matrix2i basis =
    (meshes::reduced(lattice).vectors * lattice.vectors.inverse()).array().round().cast<int>();
  std::vector<std::array<int, 2>> rulings;
  const auto add = [&](const int p, const int q)
  {
    const Eigen::RowVector2i ruling = Eigen::RowVector2i(p, q) * basis;
    rulings.push_back({ruling(0), ruling(1)});
  };
  add(1, 0);
  for (int p = -most; p <= most; ++p)
    for (int q = 1; q <= most; ++q)
      if (std::gcd(p, q) == 1)
        add(p, q);
  return rulings;
}
} // namespace homespun::homogenization
