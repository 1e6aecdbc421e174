// SPDX-License-Identifier: MIT
#include "meshes/plain/general_lattice.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homespun::meshes
{
namespace
{
/// Vertices of the outline that are tried as starts of translations. A lattice vector starts at
/// every vertex, but at one inside a side only a single one: from eight places around, all pairs of
/// sides are met.
constexpr std::size_t n_starts = 8;

/// Translations that are tried in pairs, the shortest of all.
constexpr std::size_t most_translations = 40;
} // namespace

std::optional<Lattice> lattice_by_matching(const TriangleMesh &mesh)
{
  const std::vector<int> loop = outline(mesh);
  const std::size_t n         = loop.size();
  const auto at               = [&](const std::size_t k) -> Eigen::RowVector2d
  { return mesh.vertices.row(loop[k % n]); };
  double enclosed = 0.;
  for (std::size_t k = 0; k < n; ++k)
    enclosed += 0.5 * (at(k)(0) * at(k + 1)(1) - at(k)(1) * at(k + 1)(0));
  const double tolerance = image_tolerance * std::sqrt(std::abs(enclosed));

  // Of two sides that are images, the outline runs along one forwards and along the other
  // backwards.
  std::vector<Eigen::RowVector2d> translations;
  for (std::size_t start = 0; start < std::min(n, n_starts); ++start)
  {
    const std::size_t k = start * n / std::min(n, n_starts);
    for (std::size_t j = 0; j < n; ++j)
    {
      const Eigen::RowVector2d d = at(j) - at(k);
      const bool is_image        = (at(k + 1) + d - at(j + n - 1)).norm() < tolerance ||
                            (at(k + n - 1) + d - at(j + 1)).norm() < tolerance;
      if (j == k || !is_image)
        continue;
      const Eigen::RowVector2d upwards =
        d(0) < -tolerance || (d(0) < tolerance && d(1) < 0.) ? Eigen::RowVector2d(-d) : d;
      const bool is_known = std::any_of(translations.begin(), translations.end(),
                                        [&](const Eigen::RowVector2d &other)
                                        { return (other - upwards).norm() < tolerance; });
      if (!is_known)
        translations.push_back(upwards);
    }
  }
  std::stable_sort(translations.begin(), translations.end(),
                   [&](const Eigen::RowVector2d &a, const Eigen::RowVector2d &b)
                   { return a.norm() < b.norm() - tolerance; });
  translations.resize(std::min(translations.size(), most_translations));

  for (std::size_t second = 1; second < translations.size(); ++second)
    for (std::size_t first = 0; first < second; ++first)
    {
      Lattice lattice;
      lattice.vectors << translations[first], translations[second];
      if (std::abs(lattice.area() - enclosed) > 1e-6 * enclosed)
        continue;
      // The one along x first.
      if (std::abs(lattice.vectors(1, 1)) * lattice.vectors.row(0).norm() <
          std::abs(lattice.vectors(0, 1)) * lattice.vectors.row(1).norm())
        lattice.vectors.row(0).swap(lattice.vectors.row(1));
      if (lattice.vectors.determinant() < 0.)
        lattice.vectors.row(1) *= -1.;
      if (periodicity_faults(mesh, lattice, "").empty())
        return lattice;
    }
  return std::nullopt;
}
} // namespace homespun::meshes
